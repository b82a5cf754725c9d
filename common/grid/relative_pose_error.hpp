#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include "common/base/check.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline {

/// How far pose b, seen from pose a, is from where a measurement says, in its standard deviations.
/// A cost function of graphs of poses: poses are x (m), y (m), yaw (rad); `T` may be a number that
/// differentiates itself.
class RelativePoseError {
 public:
  /// `covariance` of T_a_b: x, y (m), yaw (rad), in a's frame; positive definite.
  RelativePoseError(const Pose2& T_a_b, const Eigen::Matrix3d& covariance) : T_a_b_(T_a_b) {
    const Eigen::LLT<Eigen::Matrix3d> root(covariance.inverse());
    LIFELINE_CHECK(root.info() == Eigen::Success);
    whiten_ = root.matrixU();
  }

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::cos, std::sin;
    const T c = cos(a[2]), s = sin(a[2]);
    const T dx = b[0] - a[0], dy = b[1] - a[1];
    const Eigen::Matrix<T, 3, 1> error(c * dx + s * dy - T_a_b_.x_m, c * dy - s * dx - T_a_b_.y_m,
                                       wrapped(T(b[2] - a[2] - T_a_b_.yaw_rad)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>(residual).noalias() = whiten_.cast<T>() * error;
    return true;
  }

 private:
  template <typename T>
  static T wrapped(const T& angle_rad) {
    using std::floor;
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return angle_rad - kTurn * floor((angle_rad + std::numbers::pi) / kTurn);
  }

  Pose2 T_a_b_;
  Eigen::Matrix3d whiten_;
};

}  // namespace lifeline
