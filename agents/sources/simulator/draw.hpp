#pragma once

#include <cstdint>
#include <random>

namespace lifeline::sources {

/// Stirs numbers into a seed, so that seeds that differ a little give streams that have nothing in
/// common (the finaliser of splitmix64).
[[nodiscard]] constexpr std::uint64_t stir(std::uint64_t seed, std::uint64_t salt) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15ULL * (salt + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// Uniform draws that are the same on every machine, which the standard's distributions are not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), a multiple of 2^-53.
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * uniform(); }
  [[nodiscard]] bool chance(double probability) { return uniform() < probability; }
  /// In 0 ... count - 1; count > 0.
  [[nodiscard]] int below(int count) {
    return static_cast<int>(uniform() * static_cast<double>(count));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lifeline::sources
