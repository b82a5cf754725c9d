#include "agents/slam/failure_detector.hpp"

namespace lifeline::slam {

MatchError FailureDetector::measure(const PointSet& model_points, const PointSet& scan,
                                    const Pose2& T_model_scan) const {
  MatchError error;
  const PointGrid partners(scan.points, config_.pair_gate_m);
  const Pose2 T_scan_model = T_model_scan.inverse();
  double sum_m = 0.0;
  for (const Eigen::Vector2d& p_model : model_points.points) {
    const auto partner = partners.nearest(T_scan_model * p_model, config_.pair_gate_m);
    if (!partner) continue;
    ++error.model_points;
    sum_m += partner->distance_m;
  }
  if (error.model_points > 0) error.mean_error_m = sum_m / error.model_points;
  return error;
}

}  // namespace lifeline::slam
