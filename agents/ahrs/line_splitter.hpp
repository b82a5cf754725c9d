#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lifeline::ahrs {

/// Cuts a stream of bytes into lines. Holds one line of at most kMostBytes, whatever comes.
class LineSplitter {
 public:
  static constexpr std::size_t kMostBytes = 512;

  /// Calls `take(line, behind)` for each line that ends within `bytes`: without its end, and with
  /// how many of `bytes` came behind it. Where a line's end was lost, what begins anew within it
  /// ('$', or "P:") is taken for a line of its own. Empty lines are passed over.
  template <typename Take>
  void push(std::span<const std::uint8_t> bytes, Take take) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const auto c = static_cast<char>(bytes[i]);
      if (c != '\n' && c != '\r') {
        add(c);
      } else if (!line_.empty()) {
        take(last_start(), bytes.size() - 1 - i);
        clear();
      }
    }
  }

  /// Bytes that belonged to no line: too long ones, and what stood before a line began anew.
  [[nodiscard]] std::uint64_t lost_bytes() const { return lost_bytes_; }

  /// Forgets the line begun.
  void clear() { line_.clear(); }

 private:
  void add(char c);
  [[nodiscard]] std::string_view last_start();

  std::string line_;
  std::uint64_t lost_bytes_ = 0;
};

}  // namespace lifeline::ahrs
