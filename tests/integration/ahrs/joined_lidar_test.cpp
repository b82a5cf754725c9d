// A lidar and an attitude sensor on two lines, opened as the programs do.
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "agents/sources/open_source.hpp"
#include "common/base/angles.hpp"
#include "common/base/steady_stamp.hpp"
#include "tests/support/ahrs/ahrs_emulator.hpp"
#include "tests/support/rplidar/emulator.hpp"

namespace lifeline::sources {
namespace {

using sensing::AttitudeHealth;
using sensing::RawScan;
using std::chrono::milliseconds;

/// Nods by 25 deg and rolls by 10.
sensing::Attitude nodding(double t_s) {
  return {10.0 * kDegree * std::sin(1.5 * t_s), 25.0 * kDegree * std::sin(2.2 * t_s),
          0.3 * std::sin(0.9 * t_s)};
}

struct Helmet {
  Helmet() : ahrs({.kind = test::AhrsKind::vectornav, .head = nodding}) {}
  Result<std::unique_ptr<sensing::ScanSource>> open() {
    return open_source_with_attitude("rplidar:" + lidar.device(),
                                     "ahrs:" + ahrs.device() + "?kind=vectornav", kRealTime,
                                     stop.get_token());
  }

  test::RplidarEmulator lidar;
  test::AhrsEmulator ahrs;
  std::stop_source stop;
};

/// Scans until one is as wanted; none where that takes unreasonably many.
std::optional<RawScan> scan_with(sensing::ScanSource& source,
                                 const std::function<bool(const RawScan&)>& wanted) {
  for (int i = 0; i < 300; ++i) {
    auto scan = source.next();
    if (!scan || !*scan) return std::nullopt;
    if (wanted(**scan)) return **scan;
  }
  return std::nullopt;
}

bool is_good(const RawScan& scan) {
  return scan.attitude_health == AttitudeHealth::good && scan.attitude;
}

TEST(JoinedLidar, ItsScansCarryTheHeadsAttitudeThroughoutTheSweep) {
  Helmet helmet;
  auto source = helmet.open();
  ASSERT_TRUE(source) << source.error().text;
  int close = 0;
  for (int i = 0; i < 10; ++i) {
    const auto scan = scan_with(**source, is_good);
    ASSERT_TRUE(scan);
    const double t_s = to_seconds(scan->stamp - stamp_of(SteadyTime{}));
    const double middle_s = t_s + 0.5 * to_seconds(scan->sweep_time);
    EXPECT_GE(scan->later_attitudes.size(), 4U);
    for (const auto& later : scan->later_attitudes) {
      if (std::abs(t_s + to_seconds(later.after_stamp) - middle_s) > 0.01) continue;
      const double truth_rad = nodding(t_s + to_seconds(later.after_stamp)).pitch_rad;
      close += std::abs(later.attitude.pitch_rad - truth_rad) < 1.5 * kDegree ? 1 : 0;
      break;
    }
  }
  EXPECT_GE(close, 5);  // a late thread stamps late
}

TEST(JoinedLidar, ScansGoOnWhileTheAttitudeIsSilentAndSaySo) {
  Helmet helmet;
  auto source = helmet.open();
  ASSERT_TRUE(source);
  ASSERT_TRUE(scan_with(**source, is_good));
  helmet.ahrs.set_silent(true);
  const auto without = scan_with(**source, [](const RawScan& scan) {
    return !scan.attitude && scan.attitude_health == AttitudeHealth::silent;
  });
  EXPECT_TRUE(without);
  helmet.ahrs.set_silent(false);
  EXPECT_TRUE(scan_with(**source, is_good));
}

TEST(JoinedLidar, ScansGoOnWhileTheAttitudeIsUnpluggedAndSaySo) {
  Helmet helmet;
  auto source = helmet.open();
  ASSERT_TRUE(source);
  ASSERT_TRUE(scan_with(**source, is_good));
  helmet.ahrs.unplug();
  EXPECT_TRUE(scan_with(**source, [](const RawScan& scan) {
    return !scan.attitude && scan.attitude_health == AttitudeHealth::failed;
  }));
}

TEST(JoinedLidar, EndsWhenItIsToldTo) {
  Helmet helmet;
  auto source = helmet.open();
  ASSERT_TRUE(source);
  ASSERT_TRUE(scan_with(**source, is_good));
  helmet.stop.request_stop();
  const auto end = scan_with(**source, [](const RawScan&) { return false; });
  EXPECT_FALSE(end);
}

std::string refusal(std::string_view source, std::string_view attitude) {
  const auto opened = open_source_with_attitude(source, attitude);
  if (opened) return "opened";
  EXPECT_EQ(opened.error().code, ErrorCode::wrong_use);
  return opened.error().text;
}

TEST(OpenSourceWithAttitude, RefusesWhatDoesNotFitTogether) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal("sim:office", "ahrs:/dev/ttyUSB1"), HasSubstr("is no live lidar"));
  EXPECT_THAT(refusal("rplidar:/dev/ttyUSB0", "imu:/dev/ttyUSB1"), HasSubstr("there is: ahrs"));
  EXPECT_THAT(refusal("rplidar:/dev/ttyUSB0", "ahrs:/dev/ttyUSB1?kind=xsens"),
              HasSubstr("vectornav, ahrs8"));
  EXPECT_THAT(refusal("rplidar:/dev/ttyUSB0", "/dev/ttyUSB1"), HasSubstr("begin with a kind"));
}

TEST(OpenSourceWithAttitude, WithoutAnAttitudeItIsTheSourceAlone) {
  EXPECT_TRUE(open_source_with_attitude("sim:office?duration=1", ""));
}

}  // namespace
}  // namespace lifeline::sources
