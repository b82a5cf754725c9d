#include "agents/slam/ransac_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace lifeline::slam {

Pose2 RansacMatcher::match(const PointGrid& model, const PointSet& model_points,
                           const PointSet& scan, const Prediction& prediction) const {
  Pose2 best = prediction.T_map_head;
  if (scan.size() == 0 || model_points.size() == 0) return best;
  int best_score = score(model, scan, best);
  const double window_m = std::max(0.3, config_.window_sigmas * prediction.largest_sigma_m());
  const double window_rad = std::max(0.05, config_.window_sigmas * prediction.sigma_yaw_rad);
  std::mt19937 random(config_.seed);
  for (int trial = 0; trial < config_.trials; ++trial) {
    // The modulus favours low indices by less than one in a million: no matter here.
    const std::size_t m = random() % model_points.size();
    const std::size_t d = random() % scan.size();
    const Eigen::Vector2d &to = model_points.normals[m], &from = scan.normals[d];
    Pose2 pose{0.0, 0.0, std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to))};
    const Eigen::Vector2d t = model_points.points[m] - pose * scan.points[d];
    pose.x_m = t.x();
    pose.y_m = t.y();
    if ((t - prediction.T_map_head.translation()).norm() > window_m ||
        std::abs(normalise_angle(pose.yaw_rad - prediction.T_map_head.yaw_rad)) > window_rad) {
      continue;
    }
    const int pose_score = score(model, scan, pose);
    if (pose_score > best_score) {
      best_score = pose_score;
      best = pose;
    }
  }
  return best;
}

int RansacMatcher::score(const PointGrid& model, const PointSet& scan,
                         const Pose2& T_model_scan) const {
  const auto compared = static_cast<std::size_t>(config_.compared_points);
  const std::size_t stride = std::max<std::size_t>(1, scan.size() / compared);
  int inliers = 0;
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    inliers += model.nearest(T_model_scan * scan.points[i], config_.inlier_m).has_value() ? 1 : 0;
  }
  return inliers;
}

}  // namespace lifeline::slam
