#include "common/sharing/fixed_transform.hpp"

#include <cmath>

#include "common/base/check.hpp"

namespace lifeline::sharing {

wire::FixedTransform to_fixed(const Pose2& T_a_b) {
  LIFELINE_CHECK(T_a_b.is_finite());
  const auto fixed = [](double value) {
    return static_cast<std::int32_t>(std::llround(value * wire::FixedTransform::kOne));
  };
  return {fixed(std::cos(T_a_b.yaw_rad)), fixed(std::sin(T_a_b.yaw_rad)),
          std::llround(T_a_b.x_m * 1e6), std::llround(T_a_b.y_m * 1e6)};
}

Pose2 to_pose(const wire::FixedTransform& T_a_b) {
  return {static_cast<double>(T_a_b.x_um) * 1e-6, static_cast<double>(T_a_b.y_um) * 1e-6,
          std::atan2(static_cast<double>(T_a_b.sin_q30), static_cast<double>(T_a_b.cos_q30))};
}

PointUm transform(const wire::FixedTransform& T_a_b, PointUm p_b) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 29;
  return {((T_a_b.cos_q30 * p_b.x - T_a_b.sin_q30 * p_b.y + kHalf) >> 30) + T_a_b.x_um,
          ((T_a_b.sin_q30 * p_b.x + T_a_b.cos_q30 * p_b.y + kHalf) >> 30) + T_a_b.y_um};
}

}  // namespace lifeline::sharing
