#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace lifeline::test {

/// How often a byte of the line comes to harm.
struct NoiseRates {
  double lost = 0.0, flipped = 0.0, inserted = 0.0;

  [[nodiscard]] bool any() const { return lost + flipped + inserted > 0.0; }
};

/// Loses bytes, flips a bit of them and puts others between them.
class LineNoise {
 public:
  explicit LineNoise(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::vector<std::uint8_t> damage(std::span<const std::uint8_t> bytes,
                                                 const NoiseRates& rates) {
    std::vector<std::uint8_t> out;
    out.reserve(bytes.size() + 8);
    for (std::uint8_t byte : bytes) {
      if (chance(rates.inserted)) out.push_back(static_cast<std::uint8_t>(random_()));
      if (chance(rates.lost)) continue;
      if (chance(rates.flipped)) byte ^= static_cast<std::uint8_t>(1U << (random_() % 8));
      out.push_back(byte);
    }
    return out;
  }

 private:
  bool chance(double share) {
    if (share <= 0.0 || static_cast<double>(random_() >> 11) * 0x1p-53 >= share) return false;
    ++harmed_;
    return true;
  }

  std::mt19937_64 random_;
  std::uint64_t harmed_ = 0;

 public:
  [[nodiscard]] std::uint64_t harmed() const { return harmed_; }
};

}  // namespace lifeline::test
