#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lifeline::slam {

/// A covariance of (x, y, yaw) given in one frame, in a frame that is turned against it by yaw_rad.
[[nodiscard]] inline Eigen::Matrix3d turn_covariance(const Eigen::Matrix3d& covariance,
                                                     double yaw_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-yaw_rad).toRotationMatrix();
  return turn * covariance * turn.transpose();
}

/// Of (x, y, yaw), independent of each other and with one deviation along x and y.
[[nodiscard]] inline Eigen::Matrix3d diagonal_covariance(double xy_m, double yaw_rad) {
  return Eigen::Vector3d(xy_m * xy_m, xy_m * xy_m, yaw_rad * yaw_rad).asDiagonal();
}

/// Whether what has this covariance of (x, y, yaw) may be further off than one of the two.
[[nodiscard]] inline bool exceeds(const Eigen::Matrix3d& covariance, double xy_m, double yaw_rad) {
  return covariance(0, 0) + covariance(1, 1) > xy_m * xy_m || covariance(2, 2) > yaw_rad * yaw_rad;
}

}  // namespace lifeline::slam
