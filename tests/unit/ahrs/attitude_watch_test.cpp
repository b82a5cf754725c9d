#include "agents/ahrs/attitude_watch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "agents/ahrs/device_clock.hpp"
#include "agents/ahrs/fault_text.hpp"

namespace lifeline::ahrs {
namespace {

using std::chrono::milliseconds;

constexpr Duration kInterval = milliseconds(25);

/// A sensor on a head that sways about all axes, for a watch to look at.
class Sensor {
 public:
  explicit Sensor(double rate_factor = 1.0) : rate_factor_(rate_factor) { watch.start(now); }

  /// Readings for so long; how many were let through.
  int speak(Duration duration) {
    int used = 0;
    for (const SteadyTime end = now + duration; now < end;) {
      now += kInterval;
      used += watch.take(reading(), now, now) ? 1 : 0;
    }
    return used;
  }
  AttitudeFault fault() const { return watch.fault(now); }

  AttitudeWatch watch;
  SteadyTime now{std::chrono::hours(5)};
  bool frozen = false;
  double yaw_offset_rad = 0.0;
  bool swapped_axes = false;

 private:
  [[nodiscard]] Eigen::Quaterniond at(double t_s) const {
    return Eigen::AngleAxisd(yaw_offset_rad + std::sin(0.9 * t_s), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(0.4 * std::sin(2.0 * t_s), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(0.2 * std::sin(1.3 * t_s), Eigen::Vector3d::UnitX());
  }
  AhrsReading reading() {
    if (frozen) return last_;
    const double t_s = to_seconds(now.time_since_epoch());
    AhrsReading reading;
    reading.R_world_body = at(t_s);
    const Eigen::AngleAxisd step(at(t_s - 1e-4).conjugate() * at(t_s + 1e-4));
    const Eigen::Vector3d rate = step.angle() / 2e-4 * step.axis();
    reading.rate_rad_s = rate_factor_ * (swapped_axes ? rate.reverse().eval() : rate);
    reading.content = ++count_;
    last_ = reading;
    return reading;
  }

  double rate_factor_;
  std::uint64_t count_ = 0;
  AhrsReading last_;
};

TEST(AttitudeWatch, HasNothingAgainstASensorThatWorks) {
  Sensor sensor;
  EXPECT_EQ(sensor.speak(std::chrono::seconds(20)), 800);
  EXPECT_EQ(sensor.fault(), AttitudeFault::none);
  EXPECT_EQ(sensor.watch.rate_unit(), RateUnit::as_stated);
}

TEST(AttitudeWatch, SilenceIsNoticedWithinASecondAndForgivenAtOnce) {
  Sensor sensor;
  sensor.speak(std::chrono::seconds(3));
  sensor.now += milliseconds(200);
  EXPECT_NE(sensor.fault(), AttitudeFault::silent);
  sensor.now += milliseconds(400);
  EXPECT_EQ(sensor.fault(), AttitudeFault::silent);
  sensor.speak(milliseconds(50));
  EXPECT_EQ(sensor.fault(), AttitudeFault::gaps);
  sensor.speak(std::chrono::seconds(3));
  EXPECT_EQ(sensor.fault(), AttitudeFault::none);
  EXPECT_EQ(sensor.watch.counts().gaps, 1U);
}

TEST(AttitudeWatch, ASensorThatNeverSpokeIsSilentAndOneThatMumblesIsGarbage) {
  Sensor sensor;
  sensor.now += milliseconds(600);
  EXPECT_EQ(sensor.fault(), AttitudeFault::silent);
  sensor.watch.note_bytes(sensor.now);
  EXPECT_EQ(sensor.fault(), AttitudeFault::garbage);
}

TEST(AttitudeWatch, AFrozenSensorIsNoticedWithinASecondAndNotUsed) {
  Sensor sensor;
  sensor.speak(std::chrono::seconds(3));
  sensor.frozen = true;
  sensor.speak(milliseconds(900));
  EXPECT_EQ(sensor.fault(), AttitudeFault::frozen);
  EXPECT_EQ(sensor.speak(std::chrono::seconds(5)), 0);
  sensor.frozen = false;
  sensor.speak(milliseconds(200));
  EXPECT_NE(sensor.fault(), AttitudeFault::frozen);
}

TEST(AttitudeWatch, ALeapIsNotBelievedUntilItStays) {
  Sensor sensor;
  sensor.speak(std::chrono::seconds(3));
  sensor.yaw_offset_rad = 2.0;
  EXPECT_EQ(sensor.speak(3 * kInterval), 0);
  EXPECT_EQ(sensor.fault(), AttitudeFault::jumping);
  EXPECT_EQ(sensor.speak(10 * kInterval), 10);
  EXPECT_EQ(sensor.fault(), AttitudeFault::jumping);  // whoever looks now must know
  sensor.speak(std::chrono::seconds(3));
  EXPECT_EQ(sensor.fault(), AttitudeFault::none);
  EXPECT_EQ(sensor.watch.counts().leaps, 3U);
}

TEST(AttitudeWatch, TellsInWhichUnitTheRatesAre) {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  const auto unit_of = [](double factor) {
    Sensor sensor(factor);
    sensor.speak(std::chrono::seconds(10));
    EXPECT_EQ(sensor.fault(), factor == 1.0 ? AttitudeFault::none : AttitudeFault::rates);
    return sensor.watch.rate_unit();
  };
  EXPECT_EQ(unit_of(1.0), RateUnit::as_stated);
  EXPECT_EQ(unit_of(kDegreesPerRadian), RateUnit::degrees);
  EXPECT_EQ(unit_of(1.0 / kDegreesPerRadian), RateUnit::radians);
  EXPECT_EQ(unit_of(1.0 / 40.0), RateUnit::per_sample);
  EXPECT_EQ(unit_of(-1.0), RateUnit::disagree);
  EXPECT_EQ(unit_of(3.0), RateUnit::disagree);
}

TEST(AttitudeWatch, AxesThatAreMixedUpContradictTheAttitude) {
  Sensor sensor;
  sensor.swapped_axes = true;
  sensor.speak(std::chrono::seconds(10));
  EXPECT_EQ(sensor.watch.rate_unit(), RateUnit::disagree);
}

TEST(AttitudeWatch, SaysNothingOfRatesBeforeTheHeadHasTurned) {
  Sensor sensor(57.3);
  sensor.speak(milliseconds(100));
  EXPECT_EQ(sensor.watch.rate_unit(), RateUnit::unknown);
  EXPECT_EQ(sensor.fault(), AttitudeFault::none);
}

TEST(FaultText, NamesWhatIsWrongAndWhatToDo) {
  EXPECT_NE(fault_text(AttitudeFault::garbage, RateUnit::unknown, 57600).find("57600 baud"),
            std::string::npos);
  EXPECT_NE(fault_text(AttitudeFault::rates, RateUnit::degrees, 0).find("deg/s, not in rad/s"),
            std::string::npos);
  for (const auto fault : {AttitudeFault::silent, AttitudeFault::frozen, AttitudeFault::jumping,
                           AttitudeFault::gaps}) {
    EXPECT_NE(fault_text(fault, RateUnit::unknown, 0).find("; "), std::string::npos);
  }
}

TEST(FaultText, OnlyWhatSpoilsTheAttitudeIsHeldAgainstIt) {
  using sensing::AttitudeHealth;
  EXPECT_EQ(health_of(AttitudeFault::rates, RateUnit::degrees), AttitudeHealth::good);
  EXPECT_EQ(health_of(AttitudeFault::rates, RateUnit::disagree), AttitudeHealth::degraded);
  EXPECT_EQ(health_of(AttitudeFault::silent, RateUnit::unknown), AttitudeHealth::silent);
  EXPECT_EQ(health_of(AttitudeFault::frozen, RateUnit::unknown), AttitudeHealth::failed);
}

TEST(DeviceClock, DelaysOnTheLineDoNotReachTheStamps) {
  DeviceClock clock;
  const SteadyTime start{std::chrono::hours(2)};
  double worst_ms = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Duration device_time = milliseconds(10 * i + 777);
    // Every 7th comes at once, the others up to 16 ms late.
    const Duration late = std::chrono::microseconds(i % 7 == 0 ? 0 : (i * 7919) % 16000);
    const SteadyTime received = start + milliseconds(10 * i) + late;
    const SteadyTime stamp = clock.to_steady(device_time, received);
    EXPECT_LE(stamp, received);
    if (i >= 7) worst_ms = std::max(worst_ms, 1e3 * std::abs(to_seconds(stamp - start) - 0.01 * i));
  }
  EXPECT_LT(worst_ms, 0.1);
}

TEST(DeviceClock, FollowsAClockThatRunsSlow) {
  DeviceClock clock;
  const SteadyTime start{std::chrono::hours(2)};
  for (int i = 0; i < 100000; ++i) {
    const SteadyTime received = start + milliseconds(10 * i);
    const Duration device_time = from_seconds(0.01 * i * (1.0 - 100e-6));
    EXPECT_NEAR(to_seconds(clock.to_steady(device_time, received) - received), 0.0, 1e-4);
  }
}

TEST(DeviceClock, ARestartedSensorBeginsAnew) {
  DeviceClock clock;
  const SteadyTime start{std::chrono::hours(2)};
  (void)clock.to_steady(std::chrono::seconds(1000), start);
  EXPECT_EQ(clock.to_steady(milliseconds(5), start + milliseconds(10)), start + milliseconds(10));
  // A time that stood still while others went by.
  EXPECT_EQ(clock.to_steady(milliseconds(6), start + std::chrono::seconds(5)),
            start + std::chrono::seconds(5));
  EXPECT_EQ(clock.to_steady(std::nullopt, start), start);
}

}  // namespace
}  // namespace lifeline::ahrs
