#include "agents/sources/joined_source.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <vector>

#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

using sensing::AttitudeHealth;
using std::chrono::milliseconds;

Timestamp at_ms(int ms) {
  return Timestamp(milliseconds(ms));
}

/// Sweeps of 100 ms, one behind the other.
class Sweeps final : public sensing::ScanSource {
 public:
  Result<std::optional<sensing::RawScan>> next() override {
    sensing::RawScan scan;
    scan.stamp = at_ms(1000 + 100 * count_++);
    scan.sweep_time = milliseconds(100);
    scan.ranges_m.assign(100, 2.0F);
    return std::optional(scan);
  }

 private:
  int count_ = 0;
};

/// A sensor whose samples are there, or come only after a wait that is counted, not waited.
class Sensor final : public sensing::AttitudeSource {
 public:
  struct State {
    std::deque<sensing::OrientationSample> samples;
    AttitudeHealth health = AttitudeHealth::good;
    int waits = 0;
    Duration longest_wait{};
    bool ended = false;
  };
  explicit Sensor(State& state) : state_(state) {}

  Result<sensing::AttitudeRead> next(SteadyTime deadline) override {
    if (!state_.samples.empty()) {
      const auto sample = state_.samples.front();
      state_.samples.pop_front();
      return sensing::AttitudeRead{sample, false};
    }
    ++state_.waits;
    state_.longest_wait =
        std::max(state_.longest_wait, Duration(deadline - std::chrono::steady_clock::now()));
    return sensing::AttitudeRead{{}, state_.ended};
  }
  [[nodiscard]] AttitudeHealth health() const override { return state_.health; }

 private:
  State& state_;
};

/// Pitched by as many milliradians as it is milliseconds after the second, yawed by twice that.
sensing::OrientationSample sample(int ms) {
  const double angle_rad = 1e-3 * (ms - 1000);
  return {at_ms(ms),
          Eigen::AngleAxisd(2.0 * angle_rad, Eigen::Vector3d::UnitZ()) *
              Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitY()))};
}

struct Joined {
  Joined() : source(std::make_unique<Sweeps>(), std::make_unique<Sensor>(sensor)) {}
  void give(int from_ms, int to_ms, int step_ms = 10) {
    for (int ms = from_ms; ms <= to_ms; ms += step_ms) sensor.samples.push_back(sample(ms));
  }
  sensing::RawScan next() { return source.next().value().value(); }

  Sensor::State sensor;
  JoinedSource source;
};

TEST(JoinedSource, GivesTheAttitudeAtTheStampAndHowItGoesOn) {
  Joined joined;
  joined.give(995, 1125);
  const auto scan = joined.next();
  ASSERT_TRUE(scan.attitude);
  EXPECT_NEAR(scan.attitude->pitch_rad, 0.0, 1e-6);
  EXPECT_EQ(scan.attitude_health, AttitudeHealth::good);
  ASSERT_EQ(scan.later_attitudes.size(), 11U);  // 1005 ... 1095 and the first behind the end
  EXPECT_EQ(scan.later_attitudes[3].after_stamp, milliseconds(35));
  EXPECT_NEAR(scan.later_attitudes[3].attitude.pitch_rad, 0.035, 1e-6);
  EXPECT_EQ(scan.later_attitudes.back().after_stamp, milliseconds(105));
  EXPECT_EQ(joined.sensor.waits, 0);
  // What was read for the sweep's end serves the next one.
  joined.give(1135, 1225);
  const auto second = joined.next();
  EXPECT_NEAR(second.attitude->pitch_rad, 0.1, 1e-6);
  EXPECT_EQ(second.later_attitudes.size(), 11U);
}

TEST(JoinedSource, ASilentSensorHoldsNoScanUpBeyondItsPatience) {
  Joined joined;
  joined.give(900, 1150);
  (void)joined.next();
  const auto old = joined.next();  // sensor silent within the sweep
  ASSERT_TRUE(old.attitude);
  EXPECT_EQ(old.attitude_health, AttitudeHealth::degraded);
  EXPECT_TRUE(std::isnan(old.attitude->yaw_rad));
  const auto older = joined.next();  // 50 ms old: taken, but not believed
  ASSERT_TRUE(older.attitude);
  EXPECT_EQ(older.attitude_health, AttitudeHealth::degraded);
  const auto none = joined.next();
  EXPECT_FALSE(none.attitude);
  EXPECT_EQ(none.attitude_health, AttitudeHealth::silent);
  EXPECT_LE(joined.sensor.longest_wait, JoinedSource::kPatience);
  EXPECT_LE(joined.sensor.waits, 6);
}

TEST(JoinedSource, AfterAGapTheAttitudeIsBackAtOnce) {
  Joined joined;
  joined.give(900, 1050);
  for (int i = 0; i < 4; ++i) (void)joined.next();
  joined.give(1380, 1550);
  const auto scan = joined.next();  // 1400
  ASSERT_TRUE(scan.attitude);
  EXPECT_NEAR(scan.attitude->pitch_rad, 0.4, 1e-6);
  EXPECT_EQ(scan.attitude_health, AttitudeHealth::good);
}

TEST(JoinedSource, TheYawOfASensorThatIsNotWellIsNotHandedOn) {
  Joined joined;
  joined.give(900, 1500);
  EXPECT_TRUE(std::isfinite(joined.next().attitude->yaw_rad));
  joined.sensor.health = AttitudeHealth::degraded;  // it leapt, say
  const auto scan = joined.next();
  EXPECT_TRUE(std::isnan(scan.attitude->yaw_rad));
  EXPECT_TRUE(std::isfinite(scan.attitude->pitch_rad));
  EXPECT_EQ(scan.attitude_health, AttitudeHealth::degraded);
}

TEST(JoinedSource, AHoleWithinTheSweepLeavesItToTheAttitudeAtTheStamp) {
  Joined joined;
  joined.give(990, 1010);
  joined.give(1115, 1200);
  const auto scan = joined.next();
  EXPECT_TRUE(scan.attitude);
  EXPECT_TRUE(scan.later_attitudes.empty());
}

TEST(JoinedSource, ASensorThatEndedLeavesTheScansAlone) {
  Joined joined;
  joined.sensor.ended = true;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(joined.next().attitude);
  EXPECT_EQ(joined.sensor.waits, 1);
}

}  // namespace
}  // namespace lifeline::sources
