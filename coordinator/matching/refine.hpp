#pragma once

#include <span>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "coordinator/matching/map_features.hpp"

namespace lifeline::matching {

/// Which of a map's wall points are used.
enum class WallDetail { skeleton, all };

/// Robust Gauss-Newton on the distances between walls that face the same way, of both maps onto
/// each other. Poses are between the local frames. `scales_m` gives the width of the robust kernel
/// of each iteration: residuals beyond it hardly count. Returns the start where too little wall
/// agrees.
[[nodiscard]] Pose2 refine(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b,
                           std::span<const float> scales_m, WallDetail detail);

/// How well the agreeing walls fix a refined pose: covariance of x_m, y_m and yaw_rad of T_a_b
/// between the MAP frames, given T_a_b between the local ones. A direction that nothing fixes gets
/// about a metre or a radian.
[[nodiscard]] Eigen::Matrix3d covariance_in_map_frames(const MapFeatures& a, const MapFeatures& b,
                                                       const Pose2& T_a_b);

}  // namespace lifeline::matching
