#pragma once

#include "agents/slam/point_grid.hpp"
#include "agents/slam/point_set.hpp"

namespace lifeline::slam {

/// What Algorithm 1 looks at.
struct MatchError {
  int model_points = 0;       ///< n_m: points of the model that have a partner in the scan
  double mean_error_m = 0.0;  ///< E_TF, divided by n_m
};

/// Algorithm 1 of the paper: does the match hold? The paper adds up the distances of the pairs, so
/// its bound grows with the number of points; here E_TF0 bounds their mean (docs/decisions).
class FailureDetector {
 public:
  struct Config {
    int min_model_points = 20;       ///< n_min
    double max_mean_error_m = 0.08;  ///< E_TF0
    double pair_gate_m = 0.4;  ///< a model point without a scan point this near has no partner
  };

  explicit FailureDetector(Config config) : config_(config) {}

  /// Measures how well `scan`, at `T_model_scan`, and the model agree.
  [[nodiscard]] MatchError measure(const PointSet& model_points, const PointSet& scan,
                                   const Pose2& T_model_scan) const;

  /// DetectionResult: the match has failed. No model at all is a failure too.
  [[nodiscard]] bool detect(const MatchError& error) const {
    return error.model_points < config_.min_model_points ||
           error.mean_error_m > config_.max_mean_error_m;
  }

 private:
  Config config_;
};

}  // namespace lifeline::slam
