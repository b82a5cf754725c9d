// The device and its decoders against an emulated RPLIDAR, over a pseudo-terminal.

#include "agents/rplidar/device.hpp"

#include <cmath>
#include <ctime>
#include <random>
#include <string_view>

#include <gmock/gmock.h>

#include "agents/rplidar/frames.hpp"
#include "agents/rplidar/sample_decoder.hpp"
#include "tests/support/logged.hpp"
#include "tests/support/rplidar/emulator.hpp"
#include "tests/support/rplidar/sent_samples.hpp"

namespace lifeline::rplidar {
namespace {

using test::EmulatorOptions;
using test::Logged;
using test::RplidarEmulator;
using testing::AllOf;
using testing::HasSubstr;

SteadyTime in(std::chrono::milliseconds wait) {
  return std::chrono::steady_clock::now() + wait;
}

DeviceSettings settings_of(const RplidarEmulator& emulator, std::string mode = "") {
  return {emulator.device(), 256'000, 600, std::move(mode)};
}

std::string refusal(const DeviceSettings& settings, ErrorCode code) {
  const auto device = Device::open(settings, {});
  if (device) return "opened";
  EXPECT_EQ(device.error().code, code);
  return device.error().text;
}

/// Reads and decodes until there are `count` samples.
std::vector<Sample> read_samples(Device& device, SampleDecoder& decoder, std::size_t count) {
  std::vector<Sample> samples;
  const auto first = device.start_scan();
  EXPECT_TRUE(first) << first.error().text;
  if (!first) return samples;
  decoder.push(*first, std::chrono::steady_clock::now(), samples);
  std::array<std::uint8_t, 4096> bytes{};
  while (samples.size() < count) {
    const auto size = device.read(bytes, in(std::chrono::seconds(30)));
    EXPECT_TRUE(size) << size.error().text;
    if (!size || *size == 0) break;
    decoder.push(Bytes(bytes).first(*size), std::chrono::steady_clock::now(), samples);
  }
  return samples;
}

double thread_cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(Device, learns_who_it_is_and_how_it_scans) {
  const RplidarEmulator emulator;
  const auto device = Device::open(settings_of(emulator, "express"), {});
  ASSERT_TRUE(device) << device.error().text;
  EXPECT_EQ((*device)->info().firmware_minor, 27);
  EXPECT_EQ((*device)->info().serial_number, "A0A1A2A3A4A5A6A7A8A9AAABACADAEAF");
  EXPECT_EQ((*device)->mode().name, "Express");
  EXPECT_EQ((*device)->mode().id, 1);
  EXPECT_EQ((*device)->mode().us_per_sample, 126.0);
  EXPECT_EQ((*device)->mode().max_distance_m, 25.0);
}

TEST(Device, turns_the_rotor_while_it_is_open) {
  RplidarEmulator emulator;
  {
    const auto device = Device::open(settings_of(emulator), {});
    ASSERT_TRUE(device) << device.error().text;
    EXPECT_TRUE(test::wait_until([&] { return emulator.motor_pwm() == 600; }));
    ASSERT_TRUE((*device)->start_scan());
    EXPECT_TRUE(emulator.scanning());
  }
  EXPECT_TRUE(test::wait_until([&] { return emulator.motor_pwm() == 0 && !emulator.scanning(); }));
}

TEST(Device, does_without_a_motor_board) {
  EmulatorOptions options;
  options.has_motor_board = false;
  const RplidarEmulator emulator(options);
  const auto device = Device::open(settings_of(emulator), {});
  ASSERT_TRUE(device) << device.error().text;
  EXPECT_EQ(emulator.motor_pwm(), 0);
}

class EveryMode : public testing::TestWithParam<const char*> {};

/// Two seconds of it at the device's own rate: 32,000 samples in the dense mode, at 10 Hz.
TEST_P(EveryMode, every_sample_arrives_exactly_as_it_was_sent) {
  if (GetParam() == std::string_view("Sensitivity") && !frame_format(AnswerType::ultra_capsules)) {
    GTEST_SKIP() << "this build does not decode ultra capsules";
  }
  EmulatorOptions options;
  options.keep_frames = true;
  options.world = [random = std::mt19937(3)](double, double) mutable {
    return static_cast<std::uint16_t>(random() % 16'384);
  };
  RplidarEmulator emulator(options);
  const auto device = Device::open(settings_of(emulator, GetParam()), {});
  ASSERT_TRUE(device) << device.error().text;
  const ScanMode& mode = (*device)->mode();
  SampleDecoder decoder(static_cast<AnswerType>(mode.answer_type), mode.us_per_sample, 256'000);
  const double cpu_before_s = thread_cpu_s();
  const auto samples =
      read_samples(**device, decoder, static_cast<std::size_t>(2e6 / mode.us_per_sample));
  const double sampled_s = 1e-6 * mode.us_per_sample * static_cast<double>(samples.size());
  RecordProperty("cpu_percent",
                 std::to_string(100.0 * (thread_cpu_s() - cpu_before_s) / sampled_s));

  auto sent = test::sent_samples(emulator.frames());
  if (mode.answer_type == 0x81) sent.erase(sent.begin());  // never believed
  ASSERT_GE(sent.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(samples[i].reading.distance_quarters, sent[i].quarters) << i;
    const double off_deg = samples[i].reading.angle_q16 / 65536.0 - sent[i].angle_deg;
    ASSERT_LT(std::abs(std::remainder(off_deg, 360.0)), 1e-4) << i;
  }
  EXPECT_EQ(decoder.counts().gaps, 0U);
}

INSTANTIATE_TEST_SUITE_P(Device, EveryMode,
                         testing::Values("Standard", "Express", "Sensitivity", "DenseBoost"));

TEST(Device, that_is_not_there_is_an_error_with_advice) {
  EXPECT_THAT(refusal({"/dev/lifeline_none", 256'000, 600, ""}, ErrorCode::not_found),
              HasSubstr("/dev/lifeline_none: no such device; plug it in"));
}

TEST(Device, that_does_not_answer_is_an_error_that_names_power_cable_and_baud) {
  const test::PseudoTerminal mute;
  EXPECT_THAT(refusal({mute.device(), 256'000, 600, ""}, ErrorCode::unavailable),
              AllOf(HasSubstr("no answer"), HasSubstr("power (5 V"), HasSubstr("cable"),
                    HasSubstr("baud"), HasSubstr("now 256000")));
}

TEST(Device, at_a_wrong_baud_is_an_error_that_names_the_right_ones) {
  EmulatorOptions options;
  options.baud = 115'200;
  const RplidarEmulator emulator(options);
  EXPECT_THAT(refusal(settings_of(emulator), ErrorCode::unavailable),
              AllOf(HasSubstr("makes no sense at 256000 baud"), HasSubstr("115200")));
  EXPECT_TRUE(Device::open({emulator.device(), 115'200, 600, ""}, {}));
}

TEST(Device, with_a_health_error_is_reset_and_refused_if_that_does_not_help) {
  RplidarEmulator emulator;
  emulator.set_health(2, 0x8007);
  EXPECT_THAT(refusal(settings_of(emulator), ErrorCode::unavailable),
              AllOf(HasSubstr("health error 0x8007"), HasSubstr("power"), HasSubstr("rotor")));
  EXPECT_EQ(emulator.resets(), 1);
  emulator.heal_at_reset();
  EXPECT_TRUE(Device::open(settings_of(emulator), {}));
  EXPECT_EQ(emulator.resets(), 2);
}

TEST(Device, with_a_health_warning_works_and_says_so) {
  Logged log;
  RplidarEmulator emulator;
  emulator.set_health(1, 0x12);
  EXPECT_TRUE(Device::open(settings_of(emulator), {}));
  EXPECT_THAT(log.text(), HasSubstr("health warning 0x0012"));
}

TEST(Device, without_the_mode_asked_for_lists_those_it_has) {
  const RplidarEmulator emulator;
  EXPECT_THAT(refusal(settings_of(emulator, "turbo"), ErrorCode::wrong_use),
              AllOf(HasSubstr("has no scan mode 'turbo'"), HasSubstr("Express (7.9k samples/s)")));
}

TEST(Device, asks_again_where_the_line_loses_bytes_of_an_answer) {
  EmulatorOptions options;
  options.seed = 9;
  RplidarEmulator emulator(options);
  emulator.set_noise({.lost = 0.002});  // about one an opening
  for (int i = 0; i < 4; ++i) {
    const auto device = Device::open(settings_of(emulator), {});
    EXPECT_TRUE(device) << device.error().text;
  }
}

}  // namespace
}  // namespace lifeline::rplidar
