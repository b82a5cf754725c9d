#pragma once

#include "agents/slam/point_grid.hpp"
#include "agents/slam/point_set.hpp"

namespace lifeline::slam {

struct IcpConfig {
  int max_iterations = 30;
  double first_gate_m =
      0.4;  ///< pairs further apart do not count; falls from iteration to iteration
  double last_gate_m = 0.1;
  double gate_factor = 0.85;
};

/// The T* of Eq. 1: iterative closest points, point to point, in closed form.
class IcpMatcher {
 public:
  explicit IcpMatcher(IcpConfig config) : config_(config) {}

  /// Moves `scan` onto the model, starting at `T_model_scan`; the pose stays where fewer than three
  /// pairs are left. `model` indexes the model's points, its bins at least first_gate_m.
  [[nodiscard]] Pose2 match(const PointGrid& model, const PointSet& model_points,
                            const PointSet& scan, Pose2 T_model_scan) const;

  [[nodiscard]] const IcpConfig& config() const { return config_; }

 private:
  IcpConfig config_;
};

}  // namespace lifeline::slam
