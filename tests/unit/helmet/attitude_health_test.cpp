#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "agents/helmet_mapper.hpp"

namespace lifeline {
namespace {

using sensing::AttitudeHealth;

/// A square room, seen from its middle, every 100 ms.
sensing::RawScan room_scan(int number, AttitudeHealth health) {
  sensing::RawScan scan;
  scan.stamp = Timestamp(std::chrono::milliseconds(100) * number);
  scan.angle_step_rad = std::numbers::pi / 90.0;
  scan.range_max_m = 30.0;
  for (int i = 0; i < 180; ++i) {
    const double angle = i * scan.angle_step_rad;
    scan.ranges_m.push_back(
        static_cast<float>(3.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)))));
  }
  scan.attitude_health = health;
  return scan;
}

TEST(AttitudeHealth, IsInTheHelmetsStateAndLowersItsTrust) {
  HelmetMapper mapper({}, {0.05, 0.15}, {});
  int number = 0;
  for (int i = 0; i < 10; ++i) mapper.step(room_scan(++number, AttitudeHealth::good));
  EXPECT_EQ(mapper.state().attitude, wire::SensorHealth::good);
  const int trust = mapper.state().trust_percent;
  for (const auto& [health, told] :
       {std::pair(AttitudeHealth::degraded, wire::SensorHealth::degraded),
        std::pair(AttitudeHealth::silent, wire::SensorHealth::silent),
        std::pair(AttitudeHealth::failed, wire::SensorHealth::failed)}) {
    mapper.step(room_scan(++number, health));
    EXPECT_EQ(mapper.state().attitude, told);
  }
  EXPECT_LT(mapper.state().trust_percent, trust);
  EXPECT_EQ(mapper.state().state, wire::AgentState::tracking);  // scans go on
  for (int i = 0; i < 10; ++i) mapper.step(room_scan(++number, AttitudeHealth::good));
  EXPECT_EQ(mapper.state().trust_percent, trust);
}

}  // namespace
}  // namespace lifeline
