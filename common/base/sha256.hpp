#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace lifeline {

using Sha256Digest = std::array<std::uint8_t, 32>;

/// SHA-256 fed piece by piece. Integers go in as little-endian, so that a digest is the same on
/// every machine.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  Sha256& add(std::span<const std::uint8_t> bytes);
  Sha256& add_integer(std::uint64_t value);
  /// Length first, so that neighbouring texts cannot run together.
  Sha256& add_text(const std::string& text);
  [[nodiscard]] Sha256Digest finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// 64 lower-case hexadecimal digits (two per byte of `bytes`).
[[nodiscard]] std::string to_hex(std::span<const std::uint8_t> bytes);

}  // namespace lifeline
