#pragma once

#include <cstdint>

#include "common/grid/pose2.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Writes a transform in fixed point. Only the writer of a directive does this: readers take the
/// integers as they come.
[[nodiscard]] wire::FixedTransform to_fixed(const Pose2& T_a_b);

/// For drawing and for matching, where the last bit does not matter.
[[nodiscard]] Pose2 to_pose(const wire::FixedTransform& T_a_b);

/// A point in whole micrometres.
struct PointUm {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// The point in frame a, to the bit the same on every machine. For points and transforms within 2
/// km of their origin (check_directive).
[[nodiscard]] PointUm transform(const wire::FixedTransform& T_a_b, PointUm p_b);

}  // namespace lifeline::sharing
