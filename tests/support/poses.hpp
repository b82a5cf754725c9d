#pragma once

#include <cmath>

#include "common/grid/pose2.hpp"

namespace lifeline {

[[nodiscard]] inline double apart_m(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

[[nodiscard]] inline double apart_rad(const Pose2& a, const Pose2& b) {
  return std::abs(normalise_angle(a.yaw_rad - b.yaw_rad));
}

}  // namespace lifeline
