#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "common/base/time.hpp"

namespace lifeline::ahrs {

/// One message of an attitude sensor, its axes brought to ours: body x forward, y left, z up; world
/// z up, x east, y north (or whatever the sensor takes for north: only its z axis is relied on).
struct AhrsReading {
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();
  /// About the body's axes, in the unit that the sensor is documented to use, taken to rad/s.
  std::optional<Eigen::Vector3d> rate_rad_s;
  std::optional<Duration> device_time;  ///< since the sensor was switched on, where it says so
  std::uint64_t content = 0;            ///< hash of all that was measured, the time left out
};

/// Sensors that count x forward, y right, z down, against north, east and down (NED), in our axes.
[[nodiscard]] Eigen::Quaterniond from_ned(const Eigen::Quaterniond& R_ned_frd);
[[nodiscard]] Eigen::Vector3d from_frd(const Eigen::Vector3d& frd);

}  // namespace lifeline::ahrs
