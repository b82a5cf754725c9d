// Any bytes as a serialized LaserScan or Imu message. The first byte says as which.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "agents/sources/attitude_track.hpp"
#include "agents/sources/laser_messages.hpp"

namespace {

using lifeline::sources::RosVersion;

void require(bool condition) {
  if (!condition) std::abort();
}

void check_scan(std::span<const std::uint8_t> bytes, RosVersion version) {
  const auto scan = lifeline::sources::decode_laser_scan(bytes, version);
  if (!scan) return;
  require(scan->ranges_m.size() <= lifeline::sources::kMaxBeams);
  require(scan->ranges_m.size() * sizeof(float) <= bytes.size());
  require(std::isfinite(scan->first_angle_rad) && std::isfinite(scan->angle_step_rad));
  require(scan->range_min_m >= 0.0 && scan->range_min_m < scan->range_max_m);
  require(std::isfinite(scan->range_max_m));
  require(scan->sweep_time >= lifeline::Duration{0});
}

void check_imu(std::span<const std::uint8_t> bytes, RosVersion version) {
  const auto imu = lifeline::sources::decode_imu(bytes, version);
  if (!imu || !imu->R_world_body) return;
  const auto attitude = lifeline::sources::to_attitude(*imu->R_world_body);
  require(std::isfinite(attitude.roll_rad) && std::isfinite(attitude.pitch_rad) &&
          std::isfinite(attitude.yaw_rad));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const RosVersion version = (data[0] & 1) != 0 ? RosVersion::ros1 : RosVersion::ros2;
  if ((data[0] & 2) != 0) {
    check_imu(bytes, version);
  } else {
    check_scan(bytes, version);
  }
  return 0;
}
