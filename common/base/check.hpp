#pragma once

namespace lifeline::detail {
[[noreturn]] void check_failed(const char* condition, const char* file, int line);
}  // namespace lifeline::detail

/// Stops the program on a bug of ours; stays on in release builds. Never for input: that is a
/// Result.
#define LIFELINE_CHECK(condition) \
  ((condition) ? void(0) : ::lifeline::detail::check_failed(#condition, __FILE__, __LINE__))
