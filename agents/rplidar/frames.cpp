#include "agents/rplidar/frames.hpp"

#include "agents/rplidar/ultra_capsule.hpp"
#include "common/base/check.hpp"

namespace lifeline::rplidar {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::size_t kExpressReadings = 32, kDenseReadings = 40;
constexpr FrameFormat kStandard{5, 1, 65535 / 4000.0};
constexpr FrameFormat kExpress{84, kExpressReadings, 16.383};
constexpr FrameFormat kDense{84, kDenseReadings, 65.535};

std::uint32_t u16(Bytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at] | bytes[at + 1] << 8);
}

std::int32_t in_turn(std::int32_t angle_q16) {
  const std::int32_t rest = angle_q16 % kTurn_q16;
  return rest < 0 ? rest + kTurn_q16 : rest;
}

// Capsules: a mark in the upper half of the first two bytes, the checksum (exclusive or of the
// third byte and all after it) in their lower halves, lower half first; then the start angle, whose
// top bit says that the scan begins here.

bool is_capsule(Bytes frame) {
  if (frame[0] >> 4 != 0xA || frame[1] >> 4 != 0x5) return false;
  std::uint8_t checksum = 0;
  for (const std::uint8_t byte : frame.subspan(2)) checksum ^= byte;
  const auto sent = static_cast<std::uint8_t>((frame[0] & 0x0F) | (frame[1] & 0x0F) << 4);
  return checksum == sent && (u16(frame, 2) & 0x7FFF) < kTurn_q6;
}

bool begins_scan(Bytes capsule) {
  return (capsule[3] & 0x80) != 0;
}

std::int32_t start_angle_q16(Bytes capsule) {
  return static_cast<std::int32_t>(u16(capsule, 2) & 0x7FFF) << 10;
}

/// Sixteen cabins of two readings. A reading's 16 bits are its distance (whole mm, 14 bits) above
/// the two upper bits of how far its angle lies behind the evenly spread one; the four lower bits
/// of both, 1/8 deg each, share the cabin's last byte.
void decode_express(Bytes frame, std::int32_t start_q16, std::int32_t turn_q16, Readings& out) {
  for (std::size_t i = 0; i < kExpressReadings; ++i) {
    const std::size_t cabin = kHeaderBytes + i / 2 * 5;
    const bool second = i % 2 == 1;
    const std::uint32_t word = u16(frame, cabin + (second ? 2 : 0));
    const std::uint32_t low = second ? frame[cabin + 4] >> 4 : frame[cabin + 4] & 0x0FU;
    const auto behind_q3 = static_cast<std::int32_t>((word & 3U) << 4 | low);
    const auto spread_q16 = static_cast<std::int32_t>(turn_q16 * static_cast<std::int64_t>(i) /
                                                      static_cast<int>(kExpressReadings));
    out.of[i] = {in_turn(start_q16 + spread_q16 - (behind_q3 << 13)),
                 turn_q16 / static_cast<int>(kExpressReadings), word & 0xFFFCU};
  }
  out.count = kExpressReadings;
}

/// Forty distances in whole mm, evenly spread.
void decode_dense(Bytes frame, std::int32_t start_q16, std::int32_t turn_q16, Readings& out) {
  for (std::size_t i = 0; i < kDenseReadings; ++i) {
    const auto spread_q16 = static_cast<std::int32_t>(turn_q16 * static_cast<std::int64_t>(i) /
                                                      static_cast<int>(kDenseReadings));
    out.of[i] = {in_turn(start_q16 + spread_q16), turn_q16 / static_cast<int>(kDenseReadings),
                 u16(frame, kHeaderBytes + 2 * i) << 2};
  }
  out.count = kDenseReadings;
}

// Standard nodes: a start bit and its inverse, six bits of quality; a bit that is always set under
// 15 bits of angle; the distance. Nothing guards the distance.

bool is_standard_node(Bytes node) {
  const bool start = (node[0] & 1) != 0, not_start = (node[0] & 2) != 0;
  return start != not_start && (node[1] & 1) != 0 && u16(node, 1) >> 1 < kTurn_q6;
}

std::int32_t node_angle_q16(Bytes node) {
  return static_cast<std::int32_t>(u16(node, 1) >> 1) << 10;
}

std::optional<Readings> decode_node(Bytes node, Bytes next, std::int32_t most_turn_q16) {
  // A near reading's angle lies up to 8 deg behind a far one's: the sequence may go back a little.
  const std::int32_t angle_q16 = node_angle_q16(node);
  std::int32_t turn_q16 = in_turn(node_angle_q16(next) - angle_q16);
  if (turn_q16 > kTurn_q16 / 2) turn_q16 -= kTurn_q16;
  if (turn_q16 > most_turn_q16 || turn_q16 < -most_turn_q16) return std::nullopt;
  Readings out;
  out.of[0] = {angle_q16, turn_q16, u16(node, 3)};
  out.count = 1;
  return out;
}

}  // namespace

std::optional<FrameFormat> frame_format(AnswerType type) {
  switch (type) {
    case AnswerType::standard_nodes:
      return kStandard;
    case AnswerType::express_capsules:
      return kExpress;
    case AnswerType::dense_capsules:
      return kDense;
    case AnswerType::ultra_capsules:
      return ultra_format();
    default:
      return std::nullopt;
  }
}

bool is_frame(AnswerType type, Bytes frame) {
  const auto format = frame_format(type);
  LIFELINE_CHECK(format && frame.size() == format->bytes);
  return type == AnswerType::standard_nodes ? is_standard_node(frame) : is_capsule(frame);
}

std::optional<Readings> decode_frame(AnswerType type, Bytes frame, Bytes next,
                                     std::int32_t most_turn_q16) {
  if (type == AnswerType::standard_nodes) return decode_node(frame, next, most_turn_q16);
  if (begins_scan(next)) return std::nullopt;
  const std::int32_t start_q16 = start_angle_q16(frame);
  const std::int32_t turn_q16 = in_turn(start_angle_q16(next) - start_q16);
  if (turn_q16 > most_turn_q16) return std::nullopt;
  Readings out;
  switch (type) {
    case AnswerType::express_capsules:
      decode_express(frame, start_q16, turn_q16, out);
      break;
    case AnswerType::dense_capsules:
      decode_dense(frame, start_q16, turn_q16, out);
      break;
    default:
      decode_ultra(frame, next, start_q16, turn_q16, out);
  }
  return out;
}

}  // namespace lifeline::rplidar
