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

/// Sweeps of 100 ms, one behind the other, by a clock that may be set.
class Sweeps final : public sensing::ScanSource {
 public:
  explicit Sweeps(const int& set_back_ms) : set_back_ms_(set_back_ms) {}

  Result<std::optional<sensing::RawScan>> next() override {
    sensing::RawScan scan;
    scan.stamp = at_ms(1000 + 100 * count_++ - set_back_ms_);
    scan.sweep_time = milliseconds(100);
    scan.ranges_m.assign(100, 2.0F);
    return std::optional(scan);
  }

 private:
  const int& set_back_ms_;
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
  Joined() : source(std::make_unique<Sweeps>(set_back_ms), std::make_unique<Sensor>(sensor)) {}
  void give(int from_ms, int to_ms, int step_ms = 10) {
    for (int ms = from_ms; ms <= to_ms; ms += step_ms) sensor.samples.push_back(sample(ms));
  }
  sensing::RawScan next() { return source.next().value().value(); }

  int set_back_ms = 0;
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

TEST(JoinedSource, FollowsBothClocksWhenTheyAreSetBack) {
  Joined joined;
  joined.give(900, 1250);
  EXPECT_EQ(joined.next().attitude_health, AttitudeHealth::good);
  joined.set_back_ms = 900;  // the next sweep is stamped 200 ms, and the sensor told of 1250 ms
  joined.give(150, 550);
  for (int i = 0; i < 3; ++i) {
    const auto scan = joined.next();
    ASSERT_TRUE(scan.attitude) << i;
    EXPECT_NEAR(scan.attitude->pitch_rad, 1e-3 * (200 + 100 * i - 1000), 1e-6);
    EXPECT_EQ(scan.attitude_health, AttitudeHealth::good);
  }
}

TEST(JoinedSource, ALidarWhoseClockAloneIsSetBackHasNoAttitudeUntilItIsSetRight) {
  Joined joined;
  joined.give(900, 1250);
  (void)joined.next();
  joined.set_back_ms = 900;
  joined.give(1260, 1400);
  EXPECT_FALSE(joined.next().attitude);
  EXPECT_FALSE(joined.next().attitude);
  joined.set_back_ms = 0;  // 1300 ms
  const auto scan = joined.next();
  ASSERT_TRUE(scan.attitude);
  EXPECT_NEAR(scan.attitude->pitch_rad, 0.3, 1e-6);
}

TEST(JoinedSource, ASensorThatEndedLeavesTheScansAlone) {
  Joined joined;
  joined.sensor.ended = true;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(joined.next().attitude);
  EXPECT_EQ(joined.sensor.waits, 1);
}

}  // namespace
}  // namespace lifeline::sources
