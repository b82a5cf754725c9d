#include "agents/slam/slam_types.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace lifeline::slam {

double Prediction::largest_sigma_m() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(left_open, Eigen::EigenvaluesOnly);
  return std::sqrt(sigma_xy_m * sigma_xy_m + std::max(0.0, axes.eigenvalues().y()));
}

double deviation(const Pose2& T_map_head, const Prediction& prediction) {
  const Pose2& expected = prediction.T_map_head;
  const Eigen::Vector2d off_m = T_map_head.translation() - expected.translation();
  const double yaw =
      normalise_angle(T_map_head.yaw_rad - expected.yaw_rad) / prediction.sigma_yaw_rad;
  return 0.5 * (off_m.dot(prediction.covariance_xy().inverse() * off_m) + yaw * yaw);
}

}  // namespace lifeline::slam
