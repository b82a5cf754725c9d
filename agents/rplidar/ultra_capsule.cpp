#include "agents/rplidar/ultra_capsule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lifeline::rplidar {
namespace {

constexpr std::size_t kCabins = 32, kHeaderBytes = 4, kCabinBytes = 4;
constexpr int kReadings = 3 * static_cast<int>(kCabins);
constexpr FrameFormat kUltra{132, kReadings, 28.656};

/// A cabin: 12 bits of distance on a scale that gets coarser with distance, and two signed
/// differences of 10 bits, in the scale's unit there.
struct Cabin {
  std::uint32_t major = 0;
  std::int32_t first = 0, second = 0;
};

struct Distance {
  std::int32_t mm = 0;
  int unit_bits = 0;  ///< the scale counts 2^unit_bits mm here
};

std::int32_t signed_10_bits(std::uint32_t value) {
  return static_cast<std::int32_t>(value & 0x3FFU) - ((value & 0x200U) != 0 ? 0x400 : 0);
}

Cabin cabin_at(Bytes frame, std::size_t index) {
  const std::uint32_t word = *parse_number(frame.subspan(kHeaderBytes + kCabinBytes * index), 4);
  return {word & 0xFFFU, signed_10_bits(word >> 12), signed_10_bits(word >> 22)};
}

/// The scale: whole mm below 512, then pieces of 2, 4, 8 and 16 mm.
Distance decode_major(std::uint32_t code) {
  struct Piece {
    std::uint32_t from_code;
    std::int32_t from_mm;
    int unit_bits;
  };
  constexpr Piece kPieces[] = {
      {3328, 1 << 14, 4}, {1792, 1 << 12, 3}, {1280, 1 << 11, 2}, {512, 1 << 9, 1}, {0, 0, 0}};
  const Piece* piece = std::begin(kPieces);
  while (code < piece->from_code) ++piece;
  const auto beyond = static_cast<std::int32_t>(code - piece->from_code);
  return {piece->from_mm + (beyond << piece->unit_bits), piece->unit_bits};
}

std::uint32_t predicted_mm(const Distance& base, std::int32_t difference) {
  if (difference == -512 || difference == 511) return 0;  // nothing measured
  const std::int32_t mm = base.mm + difference * (1 << base.unit_bits);
  return static_cast<std::uint32_t>(std::max(mm, 0));
}

/// How far a reading's angle lies behind the rotor's: the receiver stands beside the laser, so near
/// things are seen at another angle than far ones (8 deg less the angle under which 24 mm appear).
std::int32_t behind_q16(std::uint32_t mm) {
  constexpr double kFar_deg = 8.0, kNear_deg = 7.5, kBaseline_mm = 24.0137;
  if (mm < 50) return static_cast<std::int32_t>(kNear_deg * 65536.0);
  const double seen_deg = std::asin(kBaseline_mm / mm) * 180.0 / std::numbers::pi;
  return static_cast<std::int32_t>((kFar_deg - seen_deg) * 65536.0);
}

}  // namespace

std::optional<FrameFormat> ultra_format() {
  return kUltra;
}

void decode_ultra(Bytes frame, Bytes next, std::int32_t start_q16, std::int32_t turn_q16,
                  Readings& out) {
  const auto add = [&](std::uint32_t mm) {
    const auto index = static_cast<std::int64_t>(out.count);
    const auto spread_q16 = static_cast<std::int32_t>(turn_q16 * index / kReadings);
    std::int32_t angle_q16 = (start_q16 + spread_q16 - behind_q16(mm)) % kTurn_q16;
    if (angle_q16 < 0) angle_q16 += kTurn_q16;
    out.of[out.count++] = {angle_q16, turn_q16 / kReadings, mm << 2};
  };
  for (std::size_t i = 0; i < kCabins; ++i) {
    const Cabin cabin = cabin_at(frame, i);
    const Distance major = decode_major(cabin.major);
    const Distance after =
        decode_major(i + 1 < kCabins ? cabin_at(frame, i + 1).major : cabin_at(next, 0).major);
    add(static_cast<std::uint32_t>(major.mm));
    // The first difference counts from this cabin's distance, the second from the next one's.
    add(predicted_mm(major.mm == 0 && after.mm != 0 ? after : major, cabin.first));
    add(predicted_mm(after, cabin.second));
  }
}

}  // namespace lifeline::rplidar
