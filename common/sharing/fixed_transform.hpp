#pragma once

#include "common/grid/pose2.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Writes a transform in fixed point. Only the writer of a directive does this: readers take the
/// integers as they come.
[[nodiscard]] wire::FixedTransform to_fixed(const Pose2& T_a_b);

/// For drawing and for matching, where the last bit does not matter.
[[nodiscard]] Pose2 to_pose(const wire::FixedTransform& T_a_b);

}  // namespace lifeline::sharing
