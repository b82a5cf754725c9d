#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// What `ros2:SCAN_TOPIC[,IMU_TOPIC]?options` says.
struct Ros2Options {
  std::string scan;          ///< with its leading '/'
  std::string imu;           ///< the same; empty for none
  std::uint32_t domain = 0;  ///< ROS_DOMAIN_ID of the driver
  std::filesystem::path qos;
  std::int64_t scans = 0;  ///< after so many the source ends; 0: never
};

/// wrong_use for names that are no ROS topics, one topic twice, unknown options and values outside
/// of their range; not_found where no QoS file is named and no configuration folder is found.
[[nodiscard]] Result<Ros2Options> read_ros2_options(const SourceSpec& spec);

/// What DDS calls a ROS 2 topic: `/scan` is `rt/scan`.
[[nodiscard]] inline std::string dds_topic(std::string_view ros_topic) {
  return "rt" + std::string(ros_topic);
}

}  // namespace lifeline::sources
