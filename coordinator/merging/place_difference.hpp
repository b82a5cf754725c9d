#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::merging {

/// How differently two transforms lay one map on another.
struct PlaceDifference {
  double distance_m = 0.0;  ///< at one point that matters
  double angle_rad = 0.0;   ///< not negative

  [[nodiscard]] double angle_deg() const { return angle_rad * 180.0 / std::numbers::pi; }
  [[nodiscard]] bool within(double max_distance_m, double max_angle_rad) const {
    return distance_m <= max_distance_m && angle_rad <= max_angle_rad;
  }
};

/// At `p_b_m`, which is best the middle of the maps' overlap: at a far origin, a small turn looks
/// like a large shift.
[[nodiscard]] inline PlaceDifference difference(const Pose2& T_a_b, const Pose2& other_T_a_b,
                                                const Eigen::Vector2d& p_b_m) {
  return {(T_a_b * p_b_m - other_T_a_b * p_b_m).norm(),
          std::abs(normalise_angle(T_a_b.yaw_rad - other_T_a_b.yaw_rad))};
}

/// Two matches that differ by no more than this found the same place.
inline constexpr double kSamePlaceM = 0.3;
inline constexpr double kSameTurnRad = 0.035;

}  // namespace lifeline::merging
