// Golden bytes: written out by hand after the protocol's description, not made by the emulator.

#include "agents/rplidar/frames.hpp"

#include <algorithm>

#include <gmock/gmock.h>

namespace lifeline::rplidar {
namespace {

using Buffer = std::vector<std::uint8_t>;

constexpr std::int32_t kDegree_q16 = 1 << 16;
constexpr std::int32_t kQuarterTurn_q16 = 90 * kDegree_q16;

/// A capsule with this start angle and payload, and the checksum that belongs to it.
Buffer capsule(std::uint16_t start_q6, const Buffer& payload, bool begins = false) {
  Buffer bytes(4 + payload.size());
  bytes[0] = 0xA0;
  bytes[1] = 0x50;
  bytes[2] = static_cast<std::uint8_t>(start_q6);
  bytes[3] = static_cast<std::uint8_t>(start_q6 >> 8 | (begins ? 0x80 : 0));
  std::copy(payload.begin(), payload.end(), bytes.begin() + 4);
  unsigned checksum = 0;
  for (std::size_t i = 2; i < bytes.size(); ++i) checksum ^= bytes[i];
  bytes[0] |= static_cast<std::uint8_t>(checksum & 0x0F);
  bytes[1] |= static_cast<std::uint8_t>(checksum >> 4);
  return bytes;
}

TEST(Frames, an_express_capsule_decodes_to_its_golden_readings) {
  // First cabin: 1000 mm, 5 3/8 deg behind (43 = 0b10'1011); 2000 mm, 1/8 deg behind (1).
  Buffer payload(80, 0);
  payload[0] = 0xA2;  // 1000 << 2 | 0b10
  payload[1] = 0x0F;
  payload[2] = 0x40;  // 2000 << 2 | 0b00
  payload[3] = 0x1F;
  payload[4] = 0x1B;                                // 0b1011 below, 0b0001 above
  const Buffer first = capsule(10 * 64, payload);   // from 10 deg ...
  const Buffer second = capsule(26 * 64, payload);  // ... to 26 deg: half a degree a reading
  EXPECT_EQ(first[0], 0xA0 | ((0x80 ^ 0x02 ^ 0xA2 ^ 0x0F ^ 0x40 ^ 0x1F ^ 0x1B) & 0x0F));
  ASSERT_TRUE(is_frame(AnswerType::express_capsules, first));
  const auto readings = decode_frame(AnswerType::express_capsules, first, second, kQuarterTurn_q16);
  ASSERT_TRUE(readings);
  ASSERT_EQ(readings->count, 32U);
  EXPECT_EQ(readings->of[0], (Reading{(10 * 8 - 43) << 13, kDegree_q16 / 2, 4000}));
  EXPECT_EQ(readings->of[1], (Reading{(10 * 8 + 4 - 1) << 13, kDegree_q16 / 2, 8000}));
  EXPECT_EQ(readings->of[31], (Reading{25 * kDegree_q16 + kDegree_q16 / 2, kDegree_q16 / 2, 0}));
}

TEST(Frames, an_express_reading_behind_zero_lies_at_the_end_of_the_turn) {
  Buffer payload(80, 0);
  payload[4] = 0x08;  // 1 deg behind
  const auto readings = decode_frame(AnswerType::express_capsules, capsule(0, payload),
                                     capsule(16 * 64, payload), kQuarterTurn_q16);
  ASSERT_TRUE(readings);
  EXPECT_EQ(readings->of[0].angle_q16, 359 * kDegree_q16);
}

TEST(Frames, a_dense_capsule_decodes_to_its_golden_readings) {
  Buffer payload(80, 0);
  payload[0] = 0xFF;  // 65,535 mm
  payload[1] = 0xFF;
  payload[78] = 0x39;  // 12,345 mm
  payload[79] = 0x30;
  const auto readings = decode_frame(AnswerType::dense_capsules, capsule(355 * 64, payload),
                                     capsule(5 * 64, payload), kQuarterTurn_q16);
  ASSERT_TRUE(readings);
  ASSERT_EQ(readings->count, 40U);
  EXPECT_EQ(readings->of[0], (Reading{355 * kDegree_q16, kDegree_q16 / 4, 4 * 65'535}));
  EXPECT_EQ(readings->of[20].angle_q16, 0);  // a quarter of a degree each, over the zero
  EXPECT_EQ(readings->of[39],
            (Reading{4 * kDegree_q16 + 3 * kDegree_q16 / 4, kDegree_q16 / 4, 4 * 12'345}));
}

TEST(Frames, a_standard_node_decodes_to_its_golden_reading) {
  const Buffer node{0x3E, 0x81, 0x16, 0x10, 0x27};  // 45 deg, 2500 mm
  const Buffer next{0x3E, 0xC1, 0x16, 0x10, 0x27};  // 45.5 deg
  ASSERT_TRUE(is_frame(AnswerType::standard_nodes, node));
  const auto readings = decode_frame(AnswerType::standard_nodes, node, next, kQuarterTurn_q16);
  ASSERT_TRUE(readings);
  ASSERT_EQ(readings->count, 1U);
  EXPECT_EQ(readings->of[0], (Reading{45 * kDegree_q16, kDegree_q16 / 2, 10'000}));
}

TEST(Frames, a_node_with_a_wrong_mark_is_none) {
  EXPECT_FALSE(is_frame(AnswerType::standard_nodes, Buffer{0x3F, 0x81, 0x16, 0x10, 0x27}));
  EXPECT_FALSE(is_frame(AnswerType::standard_nodes, Buffer{0x3C, 0x81, 0x16, 0x10, 0x27}));
  EXPECT_FALSE(is_frame(AnswerType::standard_nodes, Buffer{0x3E, 0x80, 0x16, 0x10, 0x27}));
  EXPECT_FALSE(is_frame(AnswerType::standard_nodes, Buffer{0x3E, 0x81, 0xFF, 0x10, 0x27}));
}

TEST(Frames, a_capsule_with_any_one_bit_flipped_is_none) {
  Buffer payload(80);
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::uint8_t>(37 * i);
  const Buffer whole = capsule(123 * 64, payload);
  ASSERT_TRUE(is_frame(AnswerType::dense_capsules, whole));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Buffer flipped = whole;
    flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_FALSE(is_frame(AnswerType::dense_capsules, flipped)) << bit;
  }
}

TEST(Frames, a_start_angle_beyond_a_turn_is_none) {
  EXPECT_TRUE(is_frame(AnswerType::dense_capsules, capsule(360 * 64 - 1, Buffer(80, 0))));
  EXPECT_FALSE(is_frame(AnswerType::dense_capsules, capsule(360 * 64, Buffer(80, 0))));
}

TEST(Frames, nothing_is_told_across_the_beginning_of_a_scan) {
  const Buffer one = capsule(0, Buffer(80, 0)), begin = capsule(10 * 64, Buffer(80, 0), true);
  EXPECT_FALSE(decode_frame(AnswerType::dense_capsules, one, begin, kQuarterTurn_q16));
  EXPECT_TRUE(decode_frame(AnswerType::dense_capsules, begin, capsule(20 * 64, Buffer(80, 0)),
                           kQuarterTurn_q16));
}

TEST(Frames, a_rotor_does_not_turn_farther_than_it_can) {
  const Buffer one = capsule(0, Buffer(80, 0)), far = capsule(91 * 64, Buffer(80, 0));
  EXPECT_FALSE(decode_frame(AnswerType::dense_capsules, one, far, kQuarterTurn_q16));
  EXPECT_FALSE(decode_frame(AnswerType::dense_capsules, far, one, kQuarterTurn_q16));
}

TEST(Frames, other_answers_hold_no_frames) {
  EXPECT_FALSE(frame_format(AnswerType::health));
  EXPECT_FALSE(frame_format(static_cast<AnswerType>(0x83)));
}

}  // namespace
}  // namespace lifeline::rplidar
