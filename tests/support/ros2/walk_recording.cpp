#include "tests/support/ros2/walk_recording.hpp"

#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>

#include "tests/support/recordings.hpp"

namespace lifeline::test {
namespace {

constexpr std::size_t kScanTopic = 0, kImuTopic = 1;
/// The sweep's end, by a LaserScan's figures of 24 bits, lies before this.
constexpr Duration kBehind = std::chrono::milliseconds(2);

std::uint32_t seconds_of(Timestamp stamp) {
  return static_cast<std::uint32_t>(stamp.time_since_epoch() / std::chrono::seconds(1));
}
std::uint32_t nanoseconds_of(Timestamp stamp) {
  return static_cast<std::uint32_t>((stamp.time_since_epoch() % std::chrono::seconds(1)) /
                                    std::chrono::nanoseconds(1));
}

MessageToWrite scan_message(const sensing::RawScan& scan) {
  const double beams = static_cast<double>(scan.ranges_m.size());
  const Timestamp sent = scan.stamp + scan.sweep_time + 2 * kBehind;
  return {kScanTopic, sent.time_since_epoch().count(),
          laser_message(
              {.seconds = seconds_of(scan.stamp),
               .nanoseconds = nanoseconds_of(scan.stamp),
               .angle_min = static_cast<float>(scan.first_angle_rad),
               .angle_increment = static_cast<float>(scan.angle_step_rad),
               .time_increment = static_cast<float>(to_seconds(scan.sweep_time) / (beams - 1.0)),
               .range_min = static_cast<float>(scan.range_min_m),
               .range_max = static_cast<float>(scan.range_max_m),
               .ranges = scan.ranges_m},
              Encoding::cdr_little)};
}

MessageToWrite imu_at(Timestamp stamp, const sensing::Attitude& attitude) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(attitude.yaw_rad, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(attitude.pitch_rad, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(attitude.roll_rad, Eigen::Vector3d::UnitX());
  return {kImuTopic, stamp.time_since_epoch().count(),
          imu_message({.seconds = seconds_of(stamp),
                       .nanoseconds = nanoseconds_of(stamp),
                       .x = q.x(),
                       .y = q.y(),
                       .z = q.z(),
                       .w = q.w()},
                      Encoding::cdr_little)};
}

}  // namespace

int write_walk(std::string_view source, const std::string& db3_file) {
  const Played played = play(source);
  if (!played.error.empty()) throw std::runtime_error(played.error);
  std::vector<MessageToWrite> messages;
  Timestamp last_imu{};
  for (const sensing::RawScan& scan : played.scans) {
    if (!scan.attitude) throw std::runtime_error("a scan of the walk has no attitude");
    const Timestamp end = scan.stamp + scan.sweep_time;
    sensing::Attitude attitude = *scan.attitude;
    const auto add = [&](Timestamp stamp) {
      if (stamp <= last_imu) return;
      messages.push_back(imu_at(stamp, attitude));
      last_imu = stamp;
    };
    add(scan.stamp);
    for (const auto& later : scan.later_attitudes) {
      attitude = later.attitude;
      if (scan.stamp + later.after_stamp < end) add(scan.stamp + later.after_stamp);
    }
    add(end + kBehind);
    messages.push_back(scan_message(scan));
  }
  write_db3(db3_file,
            {{"/scan", "sensor_msgs/msg/LaserScan"}, {"/imu/data", "sensor_msgs/msg/Imu"}},
            messages);
  return static_cast<int>(played.scans.size());
}

}  // namespace lifeline::test
