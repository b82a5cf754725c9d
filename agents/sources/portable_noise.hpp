#pragma once

#include <cstdint>
#include <random>

namespace lifeline::sources {

/// Normally distributed numbers that are the same bits on every machine. std::normal_distribution
/// is each library's own, and Box-Muller rests on a libm whose last bit differs between processors:
/// this adds up twelve uniform 32-bit integers, whose sum has a standard deviation of 2^32 (central
/// limit theorem; nothing lies beyond 6 sigma, the fourth moment is 2.9 instead of 3).
class PortableNoise {
 public:
  explicit PortableNoise(std::uint64_t seed) : engine_(seed) {}

  /// Mean 0, standard deviation 1.
  [[nodiscard]] double next() {
    std::int64_t sum = -kMeanOfSum;
    for (int i = 0; i < 6; ++i) {
      const std::uint64_t bits = engine_();
      sum += static_cast<std::int64_t>((bits >> 32) + (bits & 0xffff'ffffU));
    }
    return static_cast<double>(sum) / 4294967296.0;
  }

 private:
  static constexpr std::int64_t kMeanOfSum = 6 * 0xffff'ffffLL;
  std::mt19937_64 engine_;
};

/// The yaw of a helmet's attitude sensor, made from the true one: white noise plus a random walk.
/// The noise depends on the seed and on how many yaws were asked for, on nothing else.
class NoisyYaw {
 public:
  static constexpr double kWhiteSigmaDeg = 0.5;
  static constexpr double kWalkSigmaDegPerScan = 0.05;

  explicit NoisyYaw(std::uint64_t seed) : noise_(seed) {}

  /// The yaw measured at the next scan, in radians, normalised.
  [[nodiscard]] double measure(double true_yaw_rad);

 private:
  PortableNoise noise_;
  double walk_rad_ = 0.0;
};

}  // namespace lifeline::sources
