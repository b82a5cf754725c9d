#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "agents/sensing/raw_scan.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::sources {

/// How the messages of a bag are serialized.
enum class RosVersion { ros1, ros2 };

/// More beams than any planar lidar has; a message that claims more is refused.
constexpr std::size_t kMaxBeams = 32768;

/// sensor_msgs/LaserScan as a scan without attitude. bad_data for bytes that are no such message,
/// and for figures that describe no scan: an angle or a step that is not finite, a step of 0, range
/// limits that are not in order, more than kMaxBeams beams. The ranges may be anything.
[[nodiscard]] Result<sensing::RawScan> decode_laser_scan(std::span<const std::uint8_t> bytes,
                                                         RosVersion version);

/// What is of use in sensor_msgs/Imu. Body axes as ROS has them (REP 103): x forward, y left, z up.
struct ImuSample {
  Timestamp stamp{};
  /// Takes body coordinates to a frame whose z axis is up; empty where the sensor estimates none.
  std::optional<Eigen::Quaterniond> R_world_body;
};

/// sensor_msgs/Imu. bad_data for bytes that are no such message, and for an orientation that is
/// not a rotation (norm off by more than a tenth). The orientation is absent where the first
/// element of its covariance is -1 (as ROS defines) or where it is all zero.
[[nodiscard]] Result<ImuSample> decode_imu(std::span<const std::uint8_t> bytes, RosVersion version);

}  // namespace lifeline::sources
