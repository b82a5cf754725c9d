#include "agents/sources/portable_noise.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

TEST(PortableNoise, HasTheMomentsOfANormalDistribution) {
  PortableNoise noise(7);
  constexpr int kCount = 200'000;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  int within_sigma = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = noise.next();
    sum += value;
    squares += value * value;
    fourths += value * value * value * value;
    within_sigma += std::abs(value) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.01);
  EXPECT_NEAR(fourths / kCount, 2.9, 0.05);
  EXPECT_NEAR(within_sigma / double{kCount}, 0.683, 0.006);
}

TEST(PortableNoise, IsTheSameBitsForTheSameSeed) {
  PortableNoise noise(1), same(1), other(2);
  const double first = noise.next();
  EXPECT_EQ(first, same.next());
  EXPECT_NE(first, other.next());
  // Twelve 32-bit halves of the engine's first six numbers, whose values the standard fixes.
  std::mt19937_64 engine(1);
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    const std::uint64_t bits = engine();
    sum += static_cast<double>(bits >> 32) + static_cast<double>(bits & 0xffffffffU);
  }
  EXPECT_EQ(first, (sum - 6.0 * 4294967295.0) / 4294967296.0);
}

TEST(NoisyYaw, IsHalfADegreeAroundASlowWalk) {
  NoisyYaw yaw(3);
  std::vector<double> errors_deg;
  for (int i = 0; i < 20'000; ++i) errors_deg.push_back(yaw.measure(0.0) / kDegree);
  double squares = 0.0;  // of the step from scan to scan: two white errors and one of the walk
  for (std::size_t i = 1; i < errors_deg.size(); ++i) {
    squares += std::pow(errors_deg[i] - errors_deg[i - 1], 2);
  }
  const double expected = 2 * 0.5 * 0.5 + 0.05 * 0.05;
  EXPECT_NEAR(squares / static_cast<double>(errors_deg.size() - 1), expected, 0.02);
}

TEST(NoisyYaw, WalksAwayAsTheRootOfTheNumberOfScans) {
  constexpr int kWalks = 400, kScans = 900;
  double squares = 0.0;
  for (int walk = 0; walk < kWalks; ++walk) {
    NoisyYaw yaw(static_cast<std::uint64_t>(walk));
    double last = 0.0;
    for (int i = 0; i < kScans; ++i) last = yaw.measure(0.0) / kDegree;
    squares += last * last;
  }
  EXPECT_NEAR(std::sqrt(squares / kWalks), std::sqrt(0.25 + kScans * 0.0025), 0.15);
}

TEST(NoisyYaw, StaysWithinHalfATurn) {
  NoisyYaw yaw(5);
  for (int i = 0; i < 1000; ++i) EXPECT_LE(std::abs(yaw.measure(3.14)), std::numbers::pi);
}

}  // namespace
}  // namespace lifeline::sources
