#include "common/base/decimal_seconds.hpp"

#include <charconv>
#include <cstdint>

namespace lifeline {
namespace {

/// The difference of any two times must fit 64 bits too.
constexpr std::uint64_t kMaxNanoseconds = 4'000'000'000'000'000'000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// digits * 10^power, or empty where that overflows. Rounds half away from zero.
std::optional<std::uint64_t> scale(std::uint64_t digits, int power) {
  for (; power > 0 && digits != 0; --power) {
    if (digits > kMaxNanoseconds / 10) return std::nullopt;
    digits *= 10;
  }
  bool round_up = false;
  for (; power < 0 && (digits != 0 || round_up); ++power) {
    round_up = digits % 10 >= 5;
    digits /= 10;
  }
  digits += round_up ? 1 : 0;
  if (digits > kMaxNanoseconds) return std::nullopt;
  return digits;
}

}  // namespace

std::optional<Duration> parse_decimal_seconds(std::string_view text) {
  constexpr std::uint64_t kRoomForOneMore = 1'000'000'000'000'000'000;
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  std::uint64_t digits = 0;
  int power = 9;  // seconds to nanoseconds
  bool any_digit = false, after_point = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    if (text.front() == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (!is_digit(text.front())) break;
    any_digit = true;
    if (digits < kRoomForOneMore) {
      digits = digits * 10 + static_cast<std::uint64_t>(text.front() - '0');
      power -= after_point ? 1 : 0;
    } else if (!after_point) {
      return std::nullopt;  // twenty digits before the point: far beyond any clock
    }
  }
  if (!any_digit) return std::nullopt;
  if (text.starts_with('e') || text.starts_with('E')) {
    text.remove_prefix(1);
    if (text.starts_with('+')) text.remove_prefix(1);
    std::int16_t exponent = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    power += exponent;
  }
  if (!text.empty()) return std::nullopt;
  const auto nanoseconds = scale(digits, power);
  if (!nanoseconds) return std::nullopt;
  const auto count = static_cast<std::int64_t>(*nanoseconds);
  return Duration(negative ? -count : count);
}

}  // namespace lifeline
