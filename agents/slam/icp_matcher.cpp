#include "agents/slam/icp_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lifeline::slam {
namespace {

/// Pairs (a, b) and the rigid motion that brings b onto a with the least squared distance.
class Pairs {
 public:
  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    sum_a_ += a;
    sum_b_ += b;
    dot_ += b.dot(a);
    cross_ += b.x() * a.y() - b.y() * a.x();
    ++count_;
  }

  [[nodiscard]] std::optional<Pose2> solve() const {
    if (count_ < 3) return std::nullopt;
    const auto n = static_cast<double>(count_);
    const Eigen::Vector2d mean_a = sum_a_ / n, mean_b = sum_b_ / n;
    const double dot = dot_ - n * mean_b.dot(mean_a);
    const double cross = cross_ - n * (mean_b.x() * mean_a.y() - mean_b.y() * mean_a.x());
    Pose2 T_a_b{0.0, 0.0, std::atan2(cross, dot)};
    const Eigen::Vector2d t = mean_a - T_a_b * mean_b;
    T_a_b.x_m = t.x();
    T_a_b.y_m = t.y();
    return T_a_b;
  }

 private:
  Eigen::Vector2d sum_a_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum_b_ = Eigen::Vector2d::Zero();
  double dot_ = 0.0;
  double cross_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

Pose2 IcpMatcher::match(const PointGrid& model, const PointSet& model_points, const PointSet& scan,
                        Pose2 T_model_scan) const {
  double gate_m = config_.first_gate_m;
  for (int i = 0; i < config_.max_iterations; ++i) {
    Pairs pairs;
    for (const Eigen::Vector2d& p_scan : scan.points) {
      const Eigen::Vector2d p = T_model_scan * p_scan;
      if (const auto nearest = model.nearest(p, gate_m)) {
        pairs.add(model_points.points[nearest->index], p);
      }
    }
    const auto step = pairs.solve();
    if (!step) break;
    T_model_scan = *step * T_model_scan;
    const bool tight = gate_m <= config_.last_gate_m;
    if (tight && step->translation().norm() < 1e-4 && std::abs(step->yaw_rad) < 1e-5) break;
    gate_m = std::max(config_.last_gate_m, gate_m * config_.gate_factor);
  }
  return T_model_scan;
}

}  // namespace lifeline::slam
