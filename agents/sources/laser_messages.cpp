#include "agents/sources/laser_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/ros2/cdr_reader.hpp"

namespace lifeline::sources {
namespace {

/// Drivers that know no limit say infinity; no indoor lidar sees as far as this.
constexpr double kFarthest_m = 1000.0;
constexpr double kLongestSweep_s = 10.0;

Result<ros2::CdrReader> open(std::span<const std::uint8_t> bytes, RosVersion version) {
  if (version == RosVersion::ros1) return ros2::CdrReader::open_ros1(bytes);
  return ros2::CdrReader::open_cdr(bytes);
}

/// std_msgs/Header: its stamp; empty where the nanoseconds are not below one second.
std::optional<Timestamp> read_header(ros2::CdrReader& reader, RosVersion version) {
  std::int64_t seconds = 0;
  if (version == RosVersion::ros1) {
    (void)reader.read<std::uint32_t>();  // seq
    seconds = reader.read<std::uint32_t>();
  } else {
    seconds = reader.read<std::int32_t>();
  }
  const std::uint32_t nanoseconds = reader.read<std::uint32_t>();
  reader.skip_text();  // frame_id
  if (nanoseconds >= 1'000'000'000U) return std::nullopt;
  return Timestamp(std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds));
}

Result<void> check_geometry(const sensing::RawScan& scan) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (!(std::abs(scan.first_angle_rad) <= 2.0 * kTurn)) {
    return fail(ErrorCode::bad_data, "angle_min {} is no angle", scan.first_angle_rad);
  }
  if (!(std::abs(scan.angle_step_rad) <= kTurn) || scan.angle_step_rad == 0.0) {
    return fail(ErrorCode::bad_data, "angle_increment {} is no step", scan.angle_step_rad);
  }
  if (!(scan.range_min_m >= 0.0) || !(scan.range_max_m > scan.range_min_m)) {
    return fail(ErrorCode::bad_data, "range_min {} and range_max {} are no limits",
                scan.range_min_m, scan.range_max_m);
  }
  return {};
}

/// From the first to the last beam; 0 where the driver gives no usable time_increment.
Duration sweep_time(double time_increment_s, std::size_t beams) {
  const double sweep_s = time_increment_s * static_cast<double>(beams > 0 ? beams - 1 : 0);
  if (!(sweep_s >= 0.0) || sweep_s > kLongestSweep_s) return Duration{0};
  return from_seconds(sweep_s);
}

}  // namespace

Result<sensing::RawScan> decode_laser_scan(std::span<const std::uint8_t> bytes,
                                           RosVersion version) {
  auto opened = open(bytes, version);
  if (!opened) return forward_error(opened);
  ros2::CdrReader& reader = *opened;
  const auto stamp = read_header(reader, version);
  sensing::RawScan scan;
  scan.first_angle_rad = reader.read<float>();
  (void)reader.read<float>();  // angle_max: follows from the other figures
  scan.angle_step_rad = reader.read<float>();
  const float time_increment_s = reader.read<float>();
  (void)reader.read<float>();  // scan_time: from one sweep to the next
  scan.range_min_m = reader.read<float>();
  scan.range_max_m = std::min<double>(reader.read<float>(), kFarthest_m);
  scan.ranges_m = reader.read_floats(kMaxBeams);
  reader.skip_floats();  // intensities
  if (!reader.ok()) {
    return fail(ErrorCode::bad_data, "its {} bytes are no whole LaserScan of at most {} beams",
                bytes.size(), kMaxBeams);
  }
  if (!stamp) return fail(ErrorCode::bad_data, "LaserScan with a second of nanoseconds or more");
  if (const auto checked = check_geometry(scan); !checked) return forward_error(checked);
  scan.stamp = *stamp;
  scan.sweep_time = sweep_time(time_increment_s, scan.ranges_m.size());
  return scan;
}

Result<ImuSample> decode_imu(std::span<const std::uint8_t> bytes, RosVersion version) {
  auto opened = open(bytes, version);
  if (!opened) return forward_error(opened);
  ros2::CdrReader& reader = *opened;
  const auto stamp = read_header(reader, version);
  const double x = reader.read<double>(), y = reader.read<double>();
  const double z = reader.read<double>(), w = reader.read<double>();
  std::array<double, 33> rest{};  // covariance (9), rates (3 and 9), accelerations (3 and 9)
  for (double& number : rest) number = reader.read<double>();
  if (!reader.ok()) {
    return fail(ErrorCode::bad_data, "its {} bytes are no whole Imu message", bytes.size());
  }
  if (!stamp) return fail(ErrorCode::bad_data, "Imu with a second of nanoseconds or more");
  ImuSample sample{*stamp, std::nullopt};
  const Eigen::Quaterniond q(w, x, y, z);
  if (rest[0] == -1.0 || (w == 0.0 && x == 0.0 && y == 0.0 && z == 0.0)) return sample;
  if (!(std::abs(q.norm() - 1.0) <= 0.1)) {
    return fail(ErrorCode::bad_data, "Imu orientation ({}, {}, {}, {}) is no rotation", x, y, z, w);
  }
  sample.R_world_body = q.normalized();
  return sample;
}

}  // namespace lifeline::sources
