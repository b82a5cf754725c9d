#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lifeline::ros2 {

/// Writes the fields of one ROS 2 message as CdrReader::open_cdr() reads them: a 4-byte
/// encapsulation header, then plain CDR (XCDR1), little-endian on every machine, each number
/// aligned to its size from behind the header.
class CdrWriter {
 public:
  CdrWriter() : bytes_{0, 1, 0, 0} {}

  /// An integer or IEEE number of 1, 2, 4 or 8 bytes.
  template <typename Number>
  void write(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    if constexpr (std::is_same_v<Number, double>) {
      put(std::bit_cast<std::uint64_t>(value), sizeof(value));
    } else if constexpr (std::is_same_v<Number, float>) {
      put(std::bit_cast<std::uint32_t>(value), sizeof(value));
    } else {
      put(static_cast<std::uint64_t>(value), sizeof(value));
    }
  }
  /// A text with its closing zero.
  void write_text(std::string_view text);
  /// How many elements of a sequence follow.
  void write_count(std::size_t count) { write(static_cast<std::uint32_t>(count)); }
  /// A sequence of octets (int8, uint8).
  void write_octets(std::span<const std::uint8_t> octets);

  [[nodiscard]] std::vector<std::uint8_t> take() && { return std::move(bytes_); }

 private:
  void put(std::uint64_t value, std::size_t size);

  std::vector<std::uint8_t> bytes_;
};

}  // namespace lifeline::ros2
