// Attitude sensors on a real pseudo-terminal, with everything that goes wrong with them.
#include "agents/ahrs/ahrs_source.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "agents/sources/attitude_track.hpp"
#include "common/base/angles.hpp"
#include "common/base/steady_stamp.hpp"
#include "tests/support/ahrs/ahrs_emulator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::ahrs {
namespace {

using sensing::AttitudeHealth;
using std::chrono::milliseconds;
using test::AhrsEmulator;
using test::AhrsEmulatorOptions;
using test::AhrsKind;

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

/// Nods by 25 deg, rolls by 10 and looks about, all the time.
sensing::Attitude nodding(double t_s) {
  return {10.0 * kDegree * std::sin(1.5 * t_s), 25.0 * kDegree * std::sin(2.2 * t_s),
          0.8 * std::sin(0.9 * t_s)};
}

struct Line {
  explicit Line(AhrsEmulatorOptions options = {}) : kind(options.kind) {
    options.head = nodding;
    emulator.emplace(options, (folder.path() / "imu").string());
  }
  Result<std::unique_ptr<sensing::AttitudeSource>> open() {
    AhrsOptions wanted;
    wanted.device = emulator->device();
    wanted.kind = kind == AhrsKind::vectornav ? "vectornav" : "ahrs8";
    return open_ahrs_source(wanted, stop.get_token());
  }

  support::TemporaryFolder folder;
  AhrsKind kind;
  std::optional<AhrsEmulator> emulator;
  std::stop_source stop;
};

/// Reads until `done`, unreasonably long at most; false then.
bool read_until(sensing::AttitudeSource& source, const std::function<bool()>& done,
                const std::function<void(const sensing::OrientationSample&)>& use = {}) {
  const SteadyTime give_up = now() + std::chrono::seconds(60);
  while (!done()) {
    if (now() > give_up) return false;
    const auto read = source.next(now() + milliseconds(20));
    if (!read || read->ended) return false;
    if (read->sample && use) use(*read->sample);
    if (!read->sample) std::this_thread::sleep_for(milliseconds(1));
  }
  return true;
}

bool read_until_health(sensing::AttitudeSource& source, AttitudeHealth wanted) {
  return read_until(source, [&] { return source.health() == wanted; });
}

class EitherKind : public ::testing::TestWithParam<AhrsKind> {
 protected:
  static AhrsEmulatorOptions options() {
    AhrsEmulatorOptions options;
    options.kind = GetParam();
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, EitherKind, ::testing::Values(AhrsKind::vectornav, AhrsKind::ahrs8),
                         [](const auto& instance) {
                           return instance.param == AhrsKind::vectornav ? "vectornav" : "ahrs8";
                         });

TEST_P(EitherKind, SaysHowTheHeadIsHeldAtTheTimeItSays) {
  Line line(options());
  auto source = line.open();
  ASSERT_TRUE(source) << source.error().text;
  std::vector<double> off_rad;
  ASSERT_TRUE(read_until(
      **source, [&] { return off_rad.size() >= 150; },
      [&](const sensing::OrientationSample& sample) {
        const SteadyTime at(sample.stamp - stamp_of(SteadyTime{}));
        const sensing::Attitude truth = nodding(to_seconds(at.time_since_epoch()));
        const sensing::Attitude said = sources::to_attitude(sample.R_world_body);
        off_rad.push_back(std::max(std::abs(said.pitch_rad - truth.pitch_rad),
                                   std::abs(said.roll_rad - truth.roll_rad)));
      }));
  // A late thread makes a stamp late, and a moving head then looks elsewhere: not the median's
  // case.
  std::nth_element(off_rad.begin(), off_rad.begin() + 75, off_rad.end());
  EXPECT_LT(off_rad[75], 1.0 * kDegree);
  EXPECT_EQ((*source)->health(), AttitudeHealth::good);
}

TEST_P(EitherKind, ComesBackAfterItWasUnpluggedAndPluggedInAgain) {
  Line line(options());
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0;
  const auto count = [&](const auto&) { ++samples; };
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 20; }, count));
  line.emulator->unplug();
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::failed));
  line.emulator->plug_in();
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::good));
  samples = 0;
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 20; }, count));
}

TEST_P(EitherKind, SilenceIsReportedAndHeldAgainstNobodyLater) {
  Line line(options());
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0;
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 20; }, [&](const auto&) { ++samples; }));
  line.emulator->set_silent(true);
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::silent));
  // Longer than it takes to open the port anew, which alone makes nothing good.
  for (const SteadyTime end = now() + milliseconds(2800); now() < end;) {
    (void)(*source)->next(now());
    EXPECT_NE((*source)->health(), AttitudeHealth::good);
    std::this_thread::sleep_for(milliseconds(5));
  }
  line.emulator->set_silent(false);
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::good));
}

TEST_P(EitherKind, AFrozenSensorIsReportedAndItsReadingsAreNotUsed) {
  Line line(options());
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0;
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 20; }, [&](const auto&) { ++samples; }));
  line.emulator->set_frozen(true);
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::failed));
  while ((*source)->next(now())->sample) {
  }
  const std::uint64_t before = line.emulator->sentences();
  ASSERT_TRUE(read_until(
      **source, [&] { return line.emulator->sentences() > before + 250; },
      [](const auto&) { ADD_FAILURE() << "a frozen reading was handed on"; }));
  EXPECT_EQ((*source)->health(), AttitudeHealth::failed);
  line.emulator->set_frozen(false);
  ASSERT_TRUE(read_until_health(**source, AttitudeHealth::good));
}

TEST_P(EitherKind, ANoisyLineCostsReadingsAndHandsOnNothingWild) {
  AhrsEmulatorOptions noisy = options();
  Line line(noisy);
  line.emulator->set_noise({.lost = 0.002, .flipped = 0.002, .inserted = 0.001});
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0, wild = 0;
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 250; },
      [&](const sensing::OrientationSample& sample) {
        ++samples;
        const auto said = sources::to_attitude(sample.R_world_body);
        wild +=
            std::abs(said.pitch_rad) > 32.0 * kDegree || std::abs(said.roll_rad) > 17.0 * kDegree
                ? 1
                : 0;
      }));
  // An AHRS-8 has no checksum: a flipped digit may pass, but not by far.
  EXPECT_LE(wild, GetParam() == AhrsKind::vectornav ? 0 : samples / 50);
  EXPECT_LT(static_cast<std::uint64_t>(samples), line.emulator->sentences());
}

TEST_P(EitherKind, StopsAtOnceHoweverLongItWouldWait) {
  Line line(options());
  line.emulator->set_silent(true);
  auto source = line.open();
  ASSERT_TRUE(source);
  std::jthread stopper([&] {
    std::this_thread::sleep_for(milliseconds(50));
    line.stop.request_stop();
  });
  const auto read = (*source)->next(now() + std::chrono::hours(1));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->sample);
  const SteadyTime give_up = now() + std::chrono::seconds(60);
  while (!(*source)->next(now())->ended && now() < give_up) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE((*source)->next(now())->ended);
}

TEST(AhrsSource, AWrongUnitOfTheRatesIsFoundAndSpoilsNothing) {
  AhrsEmulatorOptions degrees;
  degrees.rate_scale = 1.0 / kDegree;
  Line line(degrees);
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0;
  // A busy machine may let some be missed, which degrades it for a while.
  EXPECT_TRUE(read_until(
      **source, [&] { return samples > 200 && (*source)->health() == AttitudeHealth::good; },
      [&](const auto&) { ++samples; }));
}

TEST(AhrsSource, ALeapOfTheHeadingIsReportedBeforeAnybodyUsesIt) {
  Line line;
  auto source = line.open();
  ASSERT_TRUE(source);
  int samples = 0;
  double last_yaw = 0.0;
  ASSERT_TRUE(read_until(
      **source, [&] { return samples > 20; },
      [&](const sensing::OrientationSample& sample) {
        ++samples;
        last_yaw = sources::to_attitude(sample.R_world_body).yaw_rad;
      }));
  line.emulator->set_yaw_offset(2.5);
  bool leapt = false;
  ASSERT_TRUE(read_until(
      **source, [&] { return leapt; },
      [&](const sensing::OrientationSample& sample) {
        const double yaw = sources::to_attitude(sample.R_world_body).yaw_rad;
        leapt = std::abs(normalise_angle(yaw - last_yaw)) > 1.0;
        if (leapt) {
          EXPECT_EQ((*source)->health(), AttitudeHealth::degraded);
        }
        last_yaw = yaw;
      }));
}

TEST(AhrsSource, TheWrongKindIsGarbage) {
  Line line;
  line.kind = AhrsKind::ahrs8;  // what is plugged in speaks VectorNav
  auto source = line.open();
  ASSERT_TRUE(source);
  EXPECT_TRUE(read_until_health(**source, AttitudeHealth::failed));
}

TEST(AhrsSource, ADeviceThatIsNotThereIsAnError) {
  AhrsOptions options;
  options.device = "/dev/no-such-attitude-sensor";
  const auto source = open_ahrs_source(options, {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::not_found);
  EXPECT_THAT(source.error().text, ::testing::HasSubstr("/dev/no-such-attitude-sensor"));
}

TEST(AhrsOptions, ReadsAndRefusesWhatIsWritten) {
  const auto read = [](const char* text) {
    return read_ahrs_options(sources::parse_source_spec(text).value());
  };
  const auto options = read("ahrs:/dev/ttyUSB1?kind=ahrs8&baud=57600&roll=180");
  ASSERT_TRUE(options);
  EXPECT_EQ(options->device, "/dev/ttyUSB1");
  EXPECT_EQ(options->kind, "ahrs8");
  EXPECT_EQ(options->baud, 57600);
  EXPECT_NEAR((options->R_body_sensor * Eigen::Vector3d::UnitZ()).z(), -1.0, 1e-12);
  for (const char* wrong :
       {"imu:/dev/ttyUSB1", "ahrs:/dev/ttyUSB1?kind=xsens", "ahrs:/dev/ttyUSB1?baud=1",
        "ahrs:/dev/ttyUSB1?tilt=3", "ahrs:/dev/ttyUSB1?rate=real", "ahrs:/dev/ttyUSB1?roll=200"}) {
    const auto refused = read(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().code, ErrorCode::wrong_use);
  }
}

}  // namespace
}  // namespace lifeline::ahrs
