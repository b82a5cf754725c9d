#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::merging {

/// A measured transform between two members of a group.
struct PlaceEdge {
  std::size_t a = 0;
  std::size_t b = 0;
  Pose2 T_a_b;
  Eigen::Matrix3d covariance;  ///< of T_a_b: x_m, y_m, yaw_rad; positive definite
};

struct RefinedPlaces {
  std::vector<Pose2> T_common_map;
  std::vector<Eigen::Matrix3d> covariance;  ///< of each, given the first; zero for the first
};

/// Least squares with a robust loss over all edges at once: beyond three standard deviations an
/// edge pulls no harder (Huber). The first place stays where it is. `start` has to be near; the
/// edges connect all places.
[[nodiscard]] RefinedPlaces refine_places(const std::vector<Pose2>& start,
                                          std::span<const PlaceEdge> edges);

}  // namespace lifeline::merging
