#pragma once

#include <optional>
#include <string_view>

#include "common/base/time.hpp"

namespace lifeline {

/// Seconds as decimal text (`976052890.244111`, `1.13486e+09`) to nanoseconds, digit by digit: a
/// double holds seconds since 1970 only to 0.2 us. Digits beyond the nanosecond, or beyond the
/// nineteenth significant one, are rounded off. Empty for any other text and beyond +-4e9 s (the
/// years 1843 to 2096 on a clock that counts from 1970).
[[nodiscard]] std::optional<Duration> parse_decimal_seconds(std::string_view text);

}  // namespace lifeline
