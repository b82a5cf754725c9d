#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <sensors.h>

namespace lifeline::test {

struct ScanMessage {
  sensor_msgs_msg_dds__LaserScan_ fields{};  ///< points into the two below once it is written
  std::vector<float> ranges;
  std::vector<float> intensities;
};
using ImuMessage = sensor_msgs_msg_dds__Imu_;

struct RecordedMessage {
  std::int64_t time_ns = 0;
  std::variant<ScanMessage, ImuMessage> message;
};

/// The LaserScan and Imu messages of a .db3 file of a rosbag2 recording, in the order of their
/// times: those of the topics named. Throws std::runtime_error for what it cannot read.
[[nodiscard]] std::vector<RecordedMessage> read_recording(const std::string& file,
                                                          const std::string& scan_topic,
                                                          const std::string& imu_topic);

}  // namespace lifeline::test
