#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/grid/tsd_cell.hpp"

/// Four cells or numbers at once, for the loops over whole scans: vectors of GCC and Clang, which
/// every machine has instructions for. Each lane is worked out as a single number would be, so the
/// results are the same on all of them.
namespace lifeline {

inline constexpr std::int32_t kLanes = 4;
static_assert(kTileSide % kLanes == 0);
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using FloatLanes = float __attribute__((vector_size(16)));

/// As an integer, a cell has its weight above its distance; weights stay below 32768, as PushConfig
/// caps them. So a known cell is an integer above kTsdBits.
static_assert(std::endian::native == std::endian::little && sizeof(TsdCell) == 4);
inline constexpr std::int32_t kTsdBits = 0xFFFF;

/// kLanes cells.
[[nodiscard]] inline IntLanes load_cells(const TsdCell* cells) {
  IntLanes lanes;
  std::memcpy(&lanes, cells, sizeof lanes);
  return lanes;
}
inline void store_cells(IntLanes lanes, TsdCell* cells) {
  std::memcpy(static_cast<void*>(cells), &lanes, sizeof lanes);
}

/// TsdCell::value() of each.
[[nodiscard]] inline FloatLanes values_of(IntLanes cells) {
  return __builtin_convertvector((cells << 16) >> 16, FloatLanes) *
         (1.0F / static_cast<float>(TsdCell::kTsdOne));
}

[[nodiscard]] inline bool any(IntLanes lanes) {
  using Halves = std::int64_t __attribute__((vector_size(16)));
  const auto halves = std::bit_cast<Halves>(lanes);
  return (halves[0] | halves[1]) != 0;
}

/// `mask` has all bits set or none in each lane, as comparisons give it.
[[nodiscard]] inline IntLanes choose(IntLanes mask, IntLanes yes, IntLanes no) {
  return (mask & yes) | (~mask & no);
}
[[nodiscard]] inline FloatLanes choose(IntLanes mask, FloatLanes yes, FloatLanes no) {
  return std::bit_cast<FloatLanes>(
      choose(mask, std::bit_cast<IntLanes>(yes), std::bit_cast<IntLanes>(no)));
}

[[nodiscard]] inline IntLanes magnitude(IntLanes lanes) {
  const IntLanes sign = lanes >> 31;
  return (lanes ^ sign) - sign;
}

/// As std::lround, for numbers below 2^23.
[[nodiscard]] inline IntLanes rounded(FloatLanes x) {
  const auto whole = __builtin_convertvector(x, IntLanes);
  const FloatLanes rest = x - __builtin_convertvector(whole, FloatLanes);  // exact
  return whole - (rest >= 0.5F) + (rest <= -0.5F);  // a true comparison is -1
}

/// As std::floor, for numbers that an int32_t holds.
[[nodiscard]] inline IntLanes floor_of(FloatLanes x) {
  const auto whole = __builtin_convertvector(x, IntLanes);
  return whole + (__builtin_convertvector(whole, FloatLanes) > x);  // a true comparison is -1
}

/// begin, begin + 1, ...
[[nodiscard]] inline IntLanes count_from(std::int32_t begin) {
  return IntLanes{0, 1, 2, 3} + begin;
}

/// Turns four vectors of four numbers about their diagonal.
inline void transpose(std::array<FloatLanes, 4>& rows) {
  const auto& [a, b, c, d] = rows;
  const FloatLanes ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const FloatLanes ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const FloatLanes cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const FloatLanes cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  rows = {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
          __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
          __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
          __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
}

}  // namespace lifeline
