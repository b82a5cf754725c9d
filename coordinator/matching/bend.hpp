#pragma once

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// How the rotation between the maps changes over what they share, as heading drift of a helmet
/// makes it. Starting from the rigid `T_a_b_local` (between the local frames), both maps' walls are
/// laid on each other by the conformal map w = z + k z^2 / 2 about `centre_a` (local frame of a):
/// to first order it bends along any direction, turns by Im(k z) and keeps lengths along the bent
/// line. |k| is the rate. No wall in common: a rate of 0 that is known to a radian per metre.
[[nodiscard]] Bend estimate_bend(const MapFeatures& a, const MapFeatures& b,
                                 const Pose2& T_a_b_local, const Eigen::Vector2d& centre_a);

}  // namespace lifeline::matching
