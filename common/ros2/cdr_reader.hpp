#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::ros2 {

/// Reads the fields of one serialized ROS message, from bytes that may be anything: never beyond
/// their end, and no allocation larger than they are. After the first field that does not fit,
/// ok() is false for good and every field reads as zero, so a decoder checks once, at its end.
class CdrReader {
 public:
  /// A ROS 2 message: a 4-byte encapsulation header, then plain CDR (XCDR1) in either byte order,
  /// fields aligned to their size from behind the header. bad_data for any other encapsulation.
  [[nodiscard]] static Result<CdrReader> open_cdr(std::span<const std::uint8_t> bytes);

  /// A ROS 1 message: little-endian, nothing aligned, no header, texts without a closing zero.
  [[nodiscard]] static CdrReader open_ros1(std::span<const std::uint8_t> bytes);

  [[nodiscard]] bool ok() const { return ok_; }

  /// The next field: an integer or IEEE number of 1, 2, 4 or 8 bytes.
  template <typename Number>
  [[nodiscard]] Number read() {
    static_assert(std::is_arithmetic_v<Number>);
    if constexpr (sizeof(Number) == 8) {
      return std::bit_cast<Number>(take(8));
    } else if constexpr (sizeof(Number) == 4) {
      return std::bit_cast<Number>(static_cast<std::uint32_t>(take(4)));
    } else {
      return static_cast<Number>(take(sizeof(Number)));
    }
  }

  /// A sequence of floats; fails for more than `most` of them, and before allocating where the
  /// bytes cannot hold as many as they claim.
  [[nodiscard]] std::vector<float> read_floats(std::size_t most);
  void skip_floats();
  /// A text without its closing zero; fails for more than `most` octets.
  [[nodiscard]] std::string read_text(std::size_t most);
  /// Passes over a text, whatever it says.
  void skip_text();

 private:
  CdrReader(std::span<const std::uint8_t> bytes, bool big_endian, bool aligned)
      : bytes_(bytes), big_endian_(big_endian), aligned_(aligned) {}
  [[nodiscard]] std::uint64_t take(std::size_t size);
  void skip(std::size_t size);
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  std::span<const std::uint8_t> bytes_;  ///< without the encapsulation header
  std::size_t at_ = 0;
  bool big_endian_;
  bool aligned_;
  bool ok_ = true;
};

}  // namespace lifeline::ros2
