// The live source against an emulated RPLIDAR and its faults, over a pseudo-terminal.

#include <cmath>
#include <functional>
#include <map>

#include <gmock/gmock.h>

#include "agents/rplidar/rplidar_source.hpp"
#include "tests/support/logged.hpp"
#include "tests/support/rplidar/emulator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::rplidar {
namespace {

using sensing::RawScan;
using sensing::ScanSource;
using test::Logged;
using test::RplidarEmulator;
using test::wait_until;
using testing::AllOf;
using testing::HasSubstr;

/// An emulated lidar, the source that reads it, and what is logged.
class RplidarSourceTest : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<ScanSource> open() {
    auto source = open_rplidar_source({"rplidar", emulator_.device(), {{"mode", "denseboost"}}},
                                      stop_.get_token());
    EXPECT_TRUE(source) << source.error().text;
    return source ? *std::move(source) : nullptr;
  }

  [[nodiscard]] bool logged(const std::string& text) {
    return log_.text().find(text) != std::string::npos;
  }

  /// Reads `count` sweeps; false where the source ends.
  [[nodiscard]] static bool read(ScanSource& source, int count) {
    for (int i = 0; i < count; ++i) {
      const auto scan = source.next();
      if (!scan || !*scan) return false;
    }
    return true;
  }

  /// Has a fault, and mends it as soon as the log tells of it; the source has to scan again.
  void expect_told_and_mended(const std::function<void()>& fault, const std::string& text,
                              const std::function<void()>& mend) {
    const auto source = open();
    ASSERT_TRUE(source);
    ASSERT_TRUE(read(*source, 3));
    fault();
    std::chrono::steady_clock::time_point mended;
    std::jthread mender([&] {
      EXPECT_TRUE(wait_until([&] { return logged(text); }));
      mend();
      mended = std::chrono::steady_clock::now();
    });
    while (!logged("scans again")) ASSERT_TRUE(read(*source, 1));
    mender.join();
    RecordProperty(
        "ms_until_it_scans_again",
        static_cast<int>((std::chrono::steady_clock::now() - mended).count() / 1'000'000));
    EXPECT_TRUE(read(*source, 3));
    EXPECT_TRUE(logged(text));
  }

  const support::TemporaryFolder folder_;
  Logged log_;
  std::stop_source stop_;
  RplidarEmulator emulator_{{}, (folder_.path() / "lidar").string()};
};

TEST_F(RplidarSourceTest, gives_a_sweep_a_turn_and_says_what_it_reads) {
  const auto source = open();
  ASSERT_TRUE(source);
  EXPECT_THAT(log_.text(), AllOf(HasSubstr("firmware 1.27"), HasSubstr("mode DenseBoost"),
                                 HasSubstr("16.0k samples/s")));
  std::vector<RawScan> scans;
  for (int i = 0; i < 6; ++i) scans.push_back(**source->next());
  for (std::size_t i = 2; i < scans.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(scans[i].ranges_m.size()), 1600.0, 16.0);
    EXPECT_LT(scans[i].angle_step_rad, 0.0);
    EXPECT_FALSE(scans[i].attitude);  // the head counts as level
    EXPECT_GT(scans[i].stamp, scans[i - 1].stamp);
    for (const float range_m : scans[i].ranges_m) {
      EXPECT_TRUE(range_m == 0.0F || (range_m > 1.99F && range_m < 3.7F)) << range_m;
    }
  }
}

TEST_F(RplidarSourceTest, stops_the_rotor_when_it_is_closed) {
  auto source = open();
  ASSERT_TRUE(source);
  ASSERT_TRUE(read(*source, 1));
  EXPECT_EQ(emulator_.motor_pwm(), 600);
  source.reset();
  EXPECT_TRUE(wait_until([&] { return emulator_.motor_pwm() == 0 && !emulator_.scanning(); }));
}

TEST_F(RplidarSourceTest, a_stop_ends_it_while_nothing_comes) {
  const auto source = open();
  ASSERT_TRUE(source);
  ASSERT_TRUE(read(*source, 2));
  emulator_.set_silent(true);
  std::jthread stopper([&] { stop_.request_stop(); });
  for (;;) {
    const auto scan = source->next();
    ASSERT_TRUE(scan);
    if (!*scan) break;
  }
  EXPECT_FALSE(*source->next());
}

TEST_F(RplidarSourceTest, tells_of_silence_and_scans_again_after_it) {
  expect_told_and_mended([&] { emulator_.set_silent(true); }, "silent; check power and cable",
                         [&] { emulator_.set_silent(false); });
}

TEST_F(RplidarSourceTest, tells_of_a_rotor_that_stands_and_scans_again_after_it) {
  expect_told_and_mended([&] { emulator_.set_stalled(true); },
                         "its rotor does not turn; check that nothing blocks it, and power",
                         [&] { emulator_.set_stalled(false); });
}

TEST_F(RplidarSourceTest, tells_of_the_unplugged_device_and_scans_again_when_it_is_back) {
  expect_told_and_mended([&] { emulator_.unplug(); }, "unplugged; check the plug and the cable",
                         [&] { emulator_.plug_in(); });
  EXPECT_GE(emulator_.scans_started(), 2);
}

TEST_F(RplidarSourceTest, tells_of_a_missing_device_once_and_not_at_every_attempt) {
  expect_told_and_mended([&] { emulator_.unplug(); }, "no such device; plug it in",
                         [&] {
                           // Several attempts later.
                           std::this_thread::sleep_for(std::chrono::milliseconds(700));
                           emulator_.plug_in();
                         });
  const std::string text = log_.text();
  const auto first = text.find("no such device");
  EXPECT_EQ(text.find("no such device", first + 1), std::string::npos) << text;
}

TEST_F(RplidarSourceTest, tells_of_garbage_and_scans_again_after_it) {
  expect_told_and_mended([&] { emulator_.set_noise({.flipped = 0.5}); },
                         "sends nothing that can be read", [&] { emulator_.set_noise({}); });
}

TEST_F(RplidarSourceTest, resets_a_device_that_reports_an_error_and_scans_again) {
  expect_told_and_mended(
      [&] {
        emulator_.set_health(2, 0x8002);
        emulator_.set_silent(true);
      },
      "health error 0x8002",
      [&] {
        emulator_.heal_at_reset();
        emulator_.set_silent(false);
      });
  EXPECT_GE(emulator_.resets(), 2);
}

TEST_F(RplidarSourceTest, loses_few_sweeps_on_a_bad_line) {
  const auto source = open();
  ASSERT_TRUE(source);
  emulator_.set_noise({.lost = 2e-4, .flipped = 2e-4, .inserted = 2e-4});
  for (int i = 0; i < 20; ++i) {
    const auto scan = source->next();
    ASSERT_TRUE(scan && *scan);
    for (const float range_m : (*scan)->ranges_m) {
      EXPECT_TRUE(range_m == 0.0F || (range_m > 1.99F && range_m < 3.7F)) << range_m;
    }
  }
}

TEST(RplidarOptions, are_read_and_checked) {
  const auto options = read_rplidar_options(
      {"rplidar", "/dev/lidar", {{"baud", "115200"}, {"yaw", "-90"}, {"inverted", "yes"}}});
  ASSERT_TRUE(options) << options.error().text;
  EXPECT_EQ(options->device.device, "/dev/lidar");
  EXPECT_EQ(options->device.baud, 115'200);
  EXPECT_EQ(options->device.motor_pwm, 600);
  EXPECT_NEAR(options->yaw_rad, -1.5708, 1e-4);
  EXPECT_TRUE(options->inverted);
  for (const auto& [name, value] : std::map<std::string, std::string>{{"baud", "0"},
                                                                      {"pwm", "1024"},
                                                                      {"yaw", "right"},
                                                                      {"inverted", "maybe"},
                                                                      {"speed", "1"}}) {
    const auto wrong = read_rplidar_options({"rplidar", "/dev/lidar", {{name, value}}});
    ASSERT_FALSE(wrong) << name;
    EXPECT_EQ(wrong.error().code, ErrorCode::wrong_use);
    EXPECT_THAT(wrong.error().text, HasSubstr(name));
  }
}

}  // namespace
}  // namespace lifeline::rplidar
