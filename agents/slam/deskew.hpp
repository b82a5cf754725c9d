#pragma once

#include "common/grid/pose2.hpp"
#include "common/grid/scan2.hpp"

namespace lifeline::slam {

/// Undoes the head's motion within a sweep: brings every hit to where the head stood at the first
/// beam. `motion` is the head's motion during `over`, taken to be even; of a scan whose turn the
/// attitude has undone (Scan2::turn_undone) only the translation is. Nothing is done where the
/// sweep takes no time, `over` is not positive, or the motion is too large to be true.
void deskew(Scan2& scan, const Pose2& motion, Duration over);

}  // namespace lifeline::slam
