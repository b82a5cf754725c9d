#pragma once

#include <cmath>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline {

/// A Pose2 that takes many points along: its sine and cosine are worked out once. The results are
/// Pose2's, to the bit.
class PointTransform {
 public:
  explicit PointTransform(const Pose2& T_a_b)
      : x_m_(T_a_b.x_m),
        y_m_(T_a_b.y_m),
        cos_(std::cos(T_a_b.yaw_rad)),
        sin_(std::sin(T_a_b.yaw_rad)) {}

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    return {x_m_ + cos_ * p.x() - sin_ * p.y(), y_m_ + sin_ * p.x() + cos_ * p.y()};
  }
  /// A direction, which has no place.
  [[nodiscard]] Eigen::Vector2d turned(const Eigen::Vector2d& v) const {
    return {cos_ * v.x() - sin_ * v.y(), sin_ * v.x() + cos_ * v.y()};
  }

 private:
  double x_m_, y_m_, cos_, sin_;
};

}  // namespace lifeline
