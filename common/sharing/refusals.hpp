#pragma once

#include <cstdint>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline::sharing {

/// Counts samples that were refused and logs the first and then every thousandth: a flood of bad
/// samples must not become a flood of text.
class Refusals {
 public:
  void note(std::string_view topic, const Error& error);
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
};

}  // namespace lifeline::sharing
