#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "agents/sources/simulator/plan.hpp"

namespace lifeline::sources {

using Box = Eigen::AlignedBox2d;

/// The border of what is in any of `floors` and in none of `solids`, as the longest possible
/// pieces. Closed loops; the floor lies to the left going from a to b. Exact: every coordinate is
/// one of the boxes'.
[[nodiscard]] std::vector<WallSegment> border_of(std::span<const Box> floors,
                                                 std::span<const Box> solids);

}  // namespace lifeline::sources
