#pragma once

#include "agents/slam/point_set.hpp"

namespace lifeline::slam {

struct GicpConfig {
  int max_iterations = 100;
  double max_pair_m = 0.5;  ///< points further apart are not compared
  double thin = 1e-3;       ///< variance across a surface against 1 along it
};

/// Scan against scan by generalised ICP (PCL), M_k = D_(k-1) of Eq. 4. The covariances lie in the
/// plane - thin along each point's normal, wide along the surface and upwards: left to itself, PCL
/// takes the vertical for the thin axis of a flat scan and is no better than plain ICP.
class GicpMatcher {
 public:
  explicit GicpMatcher(GicpConfig config) : config_(config) {}

  /// T_model_scan, found from `start` (Eq. 5). Returns `start` where either has too few points or
  /// the optimiser gives up; the caller judges the result.
  [[nodiscard]] Pose2 match(const PointSet& model, const PointSet& scan, const Pose2& start) const;

 private:
  GicpConfig config_;
};

}  // namespace lifeline::slam
