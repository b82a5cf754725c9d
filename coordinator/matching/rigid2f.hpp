#pragma once

#include <cmath>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::matching {

/// A Pose2 with its sine and cosine at hand, in the local frames of two features.
struct Rigid2f {
  float c = 1.0F, s = 0.0F;
  Eigen::Vector2f t = Eigen::Vector2f::Zero();

  Rigid2f() = default;
  explicit Rigid2f(const Pose2& pose)
      : c(static_cast<float>(std::cos(pose.yaw_rad))),
        s(static_cast<float>(std::sin(pose.yaw_rad))),
        t(pose.translation().cast<float>()) {}

  [[nodiscard]] Eigen::Vector2f turn(const Eigen::Vector2f& v) const {
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  [[nodiscard]] Eigen::Vector2f turn_back(const Eigen::Vector2f& v) const {
    return {c * v.x() + s * v.y(), c * v.y() - s * v.x()};
  }
  [[nodiscard]] Eigen::Vector2f operator*(const Eigen::Vector2f& p) const { return turn(p) + t; }
};

}  // namespace lifeline::matching
