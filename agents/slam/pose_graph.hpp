#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::slam {

/// A measured transform between two poses of a graph.
struct GraphEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< x, y (m), yaw (rad), in `from`
  bool may_be_wrong = false;  ///< a closed loop: loses its say where the others contradict it
};

struct GraphConfig {
  int max_iterations = 20;
  double loss_scale = 2.0;  ///< of an edge that may be wrong, in its standard deviations
};

/// Moves `poses` to where they fit the edges best (least squares, by Ceres); the first stays where
/// it is. Edges name existing poses; covariances are positive definite.
void optimise(std::vector<Pose2>& poses, std::span<const GraphEdge> edges,
              const GraphConfig& config);

}  // namespace lifeline::slam
