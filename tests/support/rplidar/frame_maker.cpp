#include "tests/support/rplidar/frame_maker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

namespace lifeline::test {
namespace {

void put_u16(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Header of a capsule; its checksum comes with seal().
void begin_capsule(EmulatedFrame& frame, bool first) {
  frame.bytes = {0xA0, 0x50};
  put_u16(frame.bytes, frame.start_q6 | (first ? 0x8000U : 0U));
}

void seal(EmulatedFrame& frame) {
  unsigned checksum = 0;
  for (std::size_t i = 2; i < frame.bytes.size(); ++i) checksum ^= frame.bytes[i];
  frame.bytes[0] = static_cast<std::uint8_t>(0xA0 | (checksum & 0x0F));
  frame.bytes[1] = static_cast<std::uint8_t>(0x50 | checksum >> 4);
}

/// Ultra scale: a code of 12 bits for a distance, rounded down, and the unit there.
struct Coded {
  std::uint32_t code, mm, unit_bits;
};
Coded code_of(std::uint32_t mm) {
  constexpr std::uint32_t kFrom[] = {1U << 14, 1U << 12, 1U << 11, 1U << 9, 0};
  constexpr std::uint32_t kCode[] = {3328, 1792, 1280, 512, 0};
  std::size_t piece = 0;
  while (mm < kFrom[piece]) ++piece;
  const auto bits = static_cast<std::uint32_t>(4 - piece);
  const std::uint32_t steps = std::min((mm - kFrom[piece]) >> bits, 4095 - kCode[piece]);
  return {kCode[piece] + steps, kFrom[piece] + (steps << bits), bits};
}

/// The nearest difference that 10 bits can say, and what it makes of the distance.
std::uint32_t difference(const Coded& base, std::uint32_t mm, std::uint32_t& coded_mm) {
  const auto unit = static_cast<std::int64_t>(1) << base.unit_bits;
  const std::int64_t steps = (static_cast<std::int64_t>(mm) - base.mm) / unit;
  if (mm == 0 || std::abs(steps) > 510) {
    coded_mm = 0;
    return 0x200;  // nothing measured
  }
  coded_mm = static_cast<std::uint32_t>(base.mm + steps * unit);
  return static_cast<std::uint32_t>(steps) & 0x3FFU;
}

}  // namespace

World room(double width_m, double depth_m) {
  return [=](double angle_deg, double) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    const double ahead = std::abs(std::cos(angle)), aside = std::abs(std::sin(angle));
    const double range_m =
        std::min(width_m / std::max(ahead, 1e-9), depth_m / std::max(aside, 1e-9));
    return static_cast<std::uint16_t>(std::lround(1000.0 * range_m));
  };
}

FrameMaker::FrameMaker(const EmulatedMode& mode, double rotor_Hz, World world, double start_deg)
    : mode_(mode),
      step_deg_(360.0 * rotor_Hz * 1e-6 * mode.us_per_sample()),
      world_(std::move(world)),
      angle_deg_(start_deg) {}

std::size_t FrameMaker::samples_per_frame() const {
  switch (mode_.answer_type) {
    case 0x81:
      return 1;
    case 0x82:
      return 32;
    case 0x84:
      return 96;
    default:
      return 40;
  }
}

EmulatedFrame FrameMaker::next(bool rotor_turns) {
  turns_ = rotor_turns;
  EmulatedFrame frame;
  // Whole 1/64 deg, as they go over the line.
  frame.start_q6 = static_cast<std::uint16_t>(std::fmod(angle_deg_, 360.0) * 64.0);
  switch (mode_.answer_type) {
    case 0x81:
      fill_node(frame);
      break;
    case 0x82:
      fill_express(frame);
      break;
    case 0x84:
      fill_ultra(frame);
      break;
    default:
      fill_dense(frame);
  }
  frame.last_sample_s = t_s_ - 1e-6 * mode_.us_per_sample();
  first_ = false;
  return frame;
}

std::uint32_t FrameMaker::next_mm() {
  const std::uint32_t mm = world_(std::fmod(angle_deg_, 360.0), t_s_);
  t_s_ += 1e-6 * mode_.us_per_sample();
  if (turns_) angle_deg_ += step_deg_;
  return mm;
}

void FrameMaker::fill_node(EmulatedFrame& frame) {
  const bool first = angle_deg_ - step_deg_ < 0.0 ||
                     std::fmod(angle_deg_, 360.0) < std::fmod(angle_deg_ - step_deg_, 360.0);
  frame.quarters.push_back(next_mm() * 4 % 65536);
  frame.bytes.push_back(static_cast<std::uint8_t>((first ? 1 : 2) | 47 << 2));
  put_u16(frame.bytes, static_cast<std::uint32_t>(frame.start_q6) << 1 | 1);
  put_u16(frame.bytes, frame.quarters[0]);
}

void FrameMaker::fill_express(EmulatedFrame& frame) {
  begin_capsule(frame, first_);
  for (int cabin = 0; cabin < 16; ++cabin) {
    std::uint32_t low_bits = 0;
    for (int half = 0; half < 2; ++half) {
      const std::uint32_t mm = std::min(next_mm(), 0x3FFFU);
      // Far things lie 8 deg behind (the most that fits), near ones less: the receiver stands
      // aside.
      const double behind_deg = mm < 50 ? 5.0 : 8.0 - 24.0 / mm * 180.0 / std::numbers::pi;
      const auto behind = static_cast<std::uint32_t>(std::clamp(behind_deg * 8.0, 0.0, 63.0));
      frame.quarters.push_back(mm << 2);
      frame.behind_q3.push_back(static_cast<std::uint8_t>(behind));
      put_u16(frame.bytes, mm << 2 | behind >> 4);
      low_bits |= (behind & 0x0F) << (4 * half);
    }
    frame.bytes.push_back(static_cast<std::uint8_t>(low_bits));
  }
  seal(frame);
}

void FrameMaker::fill_dense(EmulatedFrame& frame) {
  begin_capsule(frame, first_);
  for (int i = 0; i < 40; ++i) {
    const std::uint32_t mm = next_mm();
    frame.quarters.push_back(mm << 2);
    put_u16(frame.bytes, mm);
  }
  seal(frame);
}

void FrameMaker::fill_ultra(EmulatedFrame& frame) {
  begin_capsule(frame, first_);
  // The last difference counts from the next frame's first distance: it is measured beforehand.
  while (ahead_mm_.size() < 97) ahead_mm_.push_back(next_mm());
  for (std::size_t cabin = 0; cabin < 32; ++cabin) {
    const Coded major = code_of(ahead_mm_[3 * cabin]);
    const Coded after = code_of(ahead_mm_[3 * cabin + 3]);
    std::uint32_t first_mm = 0, second_mm = 0;
    const std::uint32_t first = difference(major.mm == 0 && after.mm != 0 ? after : major,
                                           ahead_mm_[3 * cabin + 1], first_mm);
    const std::uint32_t second = difference(after, ahead_mm_[3 * cabin + 2], second_mm);
    const std::uint32_t word = major.code | first << 12 | second << 22;
    put_u16(frame.bytes, word & 0xFFFFU);
    put_u16(frame.bytes, word >> 16);
    for (const std::uint32_t mm : {major.mm, first_mm, second_mm})
      frame.quarters.push_back(mm << 2);
  }
  ahead_mm_.erase(ahead_mm_.begin(), ahead_mm_.begin() + 96);
  seal(frame);
}

}  // namespace lifeline::test
