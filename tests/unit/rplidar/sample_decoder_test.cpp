#include "agents/rplidar/sample_decoder.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/support/rplidar/emulator.hpp"
#include "tests/support/rplidar/sent_samples.hpp"

namespace lifeline::rplidar {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::EmulatedFrame;
using test::EmulatedMode;
using test::FrameMaker;

constexpr int kBaud = 1'000'000;  // 10 us a byte
constexpr Duration kByte = microseconds(10);
const SteadyTime kFirstSample(std::chrono::seconds(1000));

/// Every distance another one, so that none can be mistaken.
test::World counting() {
  return
      [n = 0U](double, double) mutable { return static_cast<std::uint16_t>(200 + n++ % 16'000); };
}

EmulatedMode mode_of(std::uint8_t type, double us = 62.5) {
  return {"mode", static_cast<std::uint32_t>(us * 256.0), 25 << 8, type};
}

std::vector<EmulatedFrame> frames_of(const EmulatedMode& mode, int count) {
  FrameMaker maker(mode, 10.0, counting(), 350.0);
  std::vector<EmulatedFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(maker.next());
  return frames;
}

void expect_as_sent(std::span<const Sample> samples, std::span<const test::SentSample> sent) {
  ASSERT_EQ(samples.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(samples[i].reading.distance_quarters, sent[i].quarters) << i;
    const double angle_deg = samples[i].reading.angle_q16 / 65536.0;
    ASSERT_LT(std::abs(std::remainder(angle_deg - sent[i].angle_deg, 360.0)), 1e-4) << i;
  }
}

class EveryFormat : public testing::TestWithParam<std::uint8_t> {};

TEST_P(EveryFormat, decodes_every_sample_as_it_was_sent) {
  const auto type = static_cast<AnswerType>(GetParam());
  if (!frame_format(type)) GTEST_SKIP() << "this build does not decode the format";
  const EmulatedMode mode = mode_of(GetParam());
  const auto frames = frames_of(mode, 500);
  SampleDecoder decoder(type, mode.us_per_sample(), kBaud);
  std::vector<Sample> samples;
  for (const EmulatedFrame& frame : frames) decoder.push(frame.bytes, kFirstSample, samples);
  auto sent = test::sent_samples(frames);
  if (type == AnswerType::standard_nodes) {  // the first is not believed, the last wait
    sent.erase(sent.begin());
    sent.resize(sent.size() - (SampleDecoder::kNodesInRow - 2));
  }
  expect_as_sent(samples, sent);
}

TEST_P(EveryFormat, decodes_alike_however_the_bytes_are_cut) {
  const auto type = static_cast<AnswerType>(GetParam());
  if (!frame_format(type)) GTEST_SKIP() << "this build does not decode the format";
  const EmulatedMode mode = mode_of(GetParam());
  std::vector<std::uint8_t> bytes;
  for (const EmulatedFrame& frame : frames_of(mode, 60)) {
    bytes.insert(bytes.end(), frame.bytes.begin(), frame.bytes.end());
  }
  std::vector<Sample> whole, cut;
  SampleDecoder(type, mode.us_per_sample(), kBaud).push(bytes, kFirstSample, whole);
  SampleDecoder decoder(type, mode.us_per_sample(), kBaud);
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    decoder.push(Bytes(bytes).subspan(at, std::min<std::size_t>(7, bytes.size() - at)),
                 kFirstSample, cut);
  }
  ASSERT_EQ(whole.size(), cut.size());
  ASSERT_FALSE(whole.empty());
  for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_EQ(whole[i].reading, cut[i].reading) << i;
}

INSTANTIATE_TEST_SUITE_P(SampleDecoder, EveryFormat, testing::Values(0x81, 0x82, 0x84, 0x85));

TEST(SampleDecoder, stamps_each_sample_with_the_time_it_was_taken) {
  // 62.5 us a sample, 840 us on the line, sent 1.5 samples after the last one's middle.
  const EmulatedMode mode = mode_of(0x85);
  SampleDecoder decoder(AnswerType::dense_capsules, mode.us_per_sample(), kBaud);
  std::vector<Sample> samples;
  for (const EmulatedFrame& frame : frames_of(mode, 20)) {
    const Duration last_taken = from_seconds(frame.last_sample_s);
    const Duration sent = last_taken + from_seconds(1.5 * 62.5e-6);
    decoder.push(frame.bytes, kFirstSample + sent + 84 * kByte, samples);
  }
  ASSERT_EQ(samples.size(), 19U * 40U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Duration taken = from_seconds(62.5e-6 * static_cast<double>(i));
    ASSERT_LT(std::chrono::abs(samples[i].taken - kFirstSample - taken), microseconds(1)) << i;
  }
}

TEST(SampleDecoder, bytes_read_in_one_go_came_one_after_the_other) {
  const EmulatedMode mode = mode_of(0x85);
  const auto frames = frames_of(mode, 2);
  std::vector<std::uint8_t> bytes = frames[0].bytes;
  bytes.insert(bytes.end(), frames[1].bytes.begin(), frames[1].bytes.end());
  std::vector<Sample> samples;
  SampleDecoder(AnswerType::dense_capsules, 62.5, kBaud).push(bytes, kFirstSample, samples);
  ASSERT_EQ(samples.size(), 40U);
  const Duration ago = 84 * kByte + 84 * kByte + from_seconds(1.5 * 62.5e-6);
  EXPECT_LT(std::chrono::abs(samples[39].taken - (kFirstSample - ago)), microseconds(1));
}

TEST(SampleDecoder, a_late_read_hardly_moves_the_times) {
  const EmulatedMode mode = mode_of(0x85);
  SampleDecoder decoder(AnswerType::dense_capsules, mode.us_per_sample(), kBaud);
  std::vector<Sample> samples;
  int index = 0;
  for (const EmulatedFrame& frame : frames_of(mode, 400)) {
    const Duration late = milliseconds(index++ % 10 == 5 ? 20 : 0);
    decoder.push(frame.bytes, kFirstSample + from_seconds(frame.last_sample_s) + late, samples);
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Duration step = samples[i].taken - samples[i - 1].taken;
    ASSERT_LT(std::chrono::abs(step - from_seconds(62.5e-6)), microseconds(250)) << i;
  }
}

TEST(FrameClock, follows_a_pace_that_is_not_quite_the_stated_one) {
  FrameClock clock(microseconds(2500));
  SteadyTime read = kFirstSample, told{};
  for (int i = 0; i < 4000; ++i) {
    told = clock.next(read, i > 0);
    read += microseconds(2510);  // 0.4 % slower than stated
  }
  EXPECT_LT(std::chrono::abs(told - (read - microseconds(2510))), microseconds(1100));
}

TEST(FrameClock, begins_anew_behind_a_gap) {
  FrameClock clock(microseconds(2500));
  EXPECT_EQ(clock.next(kFirstSample, false), kFirstSample);
  EXPECT_EQ(clock.next(kFirstSample + milliseconds(50), false), kFirstSample + milliseconds(50));
  EXPECT_EQ(clock.next(kFirstSample + milliseconds(500), true), kFirstSample + milliseconds(500));
}

TEST(SampleDecoder, a_frame_that_the_device_left_out_is_not_bridged) {
  auto frames = frames_of(mode_of(0x85), 30);
  frames.erase(frames.begin() + 15);
  SampleDecoder decoder(AnswerType::dense_capsules, 62.5, kBaud);
  std::vector<Sample> samples;
  for (const EmulatedFrame& frame : frames) decoder.push(frame.bytes, kFirstSample, samples);
  // The one before the gap has no end: it is lost as well.
  ASSERT_EQ(samples.size(), 27U * 40U);
  EXPECT_EQ(samples[14 * 40].reading.distance_quarters, frames[15].quarters[0]);
  EXPECT_TRUE(samples[14 * 40].after_gap);
  EXPECT_EQ(decoder.counts().gaps, 1U);
}

TEST(SampleDecoder, garbage_gives_nothing_and_is_counted) {
  std::mt19937 random(5);
  std::vector<std::uint8_t> garbage(100'000);
  for (auto& byte : garbage) byte = static_cast<std::uint8_t>(random());
  SampleDecoder decoder(AnswerType::dense_capsules, 62.5, kBaud);
  std::vector<Sample> samples;
  decoder.push(garbage, kFirstSample, samples);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(decoder.counts().bytes, 100'000U);
  EXPECT_GT(decoder.counts().skipped, 99'000U);
}

}  // namespace
}  // namespace lifeline::rplidar
