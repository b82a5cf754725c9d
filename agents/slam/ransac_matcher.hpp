#pragma once

#include <cstdint>

#include "agents/slam/point_grid.hpp"
#include "agents/slam/point_set.hpp"
#include "agents/slam/slam_types.hpp"

namespace lifeline::slam {

struct RansacConfig {
  int trials = 200;
  int compared_points = 60;    ///< of the scan, to score a trial
  double inlier_m = 0.15;      ///< a point this near to the model agrees with it
  double window_sigmas = 3.0;  ///< trials further from the prediction are not scored
  std::uint32_t seed = 1;
};

/// Pre-alignment before ICP: a point of the model and a point of the scan, laid on each other with
/// their normals, give a pose; of many such trials the one with the most points near the model is
/// taken. The prediction itself is the first trial, so the result is never worse. Deterministic.
class RansacMatcher {
 public:
  explicit RansacMatcher(RansacConfig config) : config_(config) {}

  /// `model` indexes the model's points, its bins at least inlier_m.
  [[nodiscard]] Pose2 match(const PointGrid& model, const PointSet& model_points,
                            const PointSet& scan, const Prediction& prediction) const;

 private:
  [[nodiscard]] int score(const PointGrid& model, const PointSet& scan,
                          const Pose2& T_model_scan) const;

  RansacConfig config_;
};

}  // namespace lifeline::slam
