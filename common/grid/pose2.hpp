#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace lifeline {

/// `angle_rad` brought into (-pi, pi].
[[nodiscard]] inline double normalise_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

/// A rigid transform of the plane. `T_a_b` takes coordinates in b to coordinates in a: p_a = T_a_b
/// * p_b. As a position of b in a: x forward, y left, yaw counter-clockwise.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;  ///< in (-pi, pi] after any operation below

  [[nodiscard]] Eigen::Vector2d translation() const { return {x_m, y_m}; }

  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {-c * x_m - s * y_m, s * x_m - c * y_m, normalise_angle(-yaw_rad)};
  }

  /// T_a_c = T_a_b * T_b_c
  [[nodiscard]] Pose2 operator*(const Pose2& other) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {x_m + c * other.x_m - s * other.y_m, y_m + s * other.x_m + c * other.y_m,
            normalise_angle(yaw_rad + other.yaw_rad)};
  }

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return {x_m + c * p.x() - s * p.y(), y_m + s * p.x() + c * p.y()};
  }

  [[nodiscard]] bool is_finite() const {
    return std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(yaw_rad);
  }
};

}  // namespace lifeline
