#pragma once

#include "common/base/time.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline {

/// Where something was, and when. Of a helmet: T_map_head.
struct StampedPose {
  Timestamp stamp;
  Pose2 pose;
};

}  // namespace lifeline
