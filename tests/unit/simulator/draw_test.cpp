#include "agents/sources/simulator/draw.hpp"

#include <set>

#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

TEST(Draw, GivesTheSameNumbersOnEveryMachine) {
  Draw draw(5489);
  for (int i = 1; i < 10'000; ++i) (void)draw.uniform();
  // The C++ standard names the 10000th number of this engine under this seed.
  EXPECT_EQ(draw.uniform(), static_cast<double>(9981545732273789042ULL >> 11) * 0x1.0p-53);
}

TEST(Draw, StaysWithinItsLimits) {
  Draw draw(2);
  std::set<int> seen;
  for (int i = 0; i < 1000; ++i) {
    const double value = draw.between(-2.0, 3.0);
    EXPECT_GE(value, -2.0);
    EXPECT_LT(value, 3.0);
    seen.insert(draw.below(3));
    EXPECT_FALSE(draw.chance(0.0));
    EXPECT_TRUE(draw.chance(1.0));
  }
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2}));
}

TEST(Draw, StirredSeedsHaveNothingInCommon) {
  std::set<std::uint64_t> stirred;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (std::uint64_t salt = 0; salt < 50; ++salt) stirred.insert(stir(seed, salt));
  }
  EXPECT_EQ(stirred.size(), 2500U);
}

}  // namespace
}  // namespace lifeline::sources
