#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lifeline::ahrs {

/// Takes a line's comma-separated fields off its front, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view line) : rest_(line) {}

  /// The next field, blanks around it taken off; empty (no value) behind the last.
  [[nodiscard]] std::optional<std::string_view> next();
  /// The next field, left where it is.
  [[nodiscard]] std::optional<std::string_view> peek() const { return Fields(*this).next(); }

 private:
  std::optional<std::string_view> rest_;
};

/// The whole of `text` as a finite decimal number; a sign + is allowed.
[[nodiscard]] std::optional<double> read_number(std::string_view text);

/// FNV-1a: equal texts have equal hashes.
[[nodiscard]] std::uint64_t hash_text(std::string_view text);

}  // namespace lifeline::ahrs
