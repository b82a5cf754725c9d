// Maps of helmets whose heading drifts: they cannot be joined by one rigid transform.

#include <string>

#include <gtest/gtest.h>

#include "agents/sources/simulator/office.hpp"
#include "common/base/angles.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::matching {
namespace {

class BentMapsTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  // Two helmets go the same way through an office; the second one's heading drifts.
  [[nodiscard]] MatchResult match(double drift_deg_per_m) const {
    const auto floor = test::SimulatedFloor::make(
        sources::generate_office({.seed = GetParam(), .width_m = 30.0, .depth_m = 20.0}).value());
    test::SimulatedView first, second;
    first.walker = second.walker = {.seed = 3, .walker = 0, .walkers = 2};
    first.until_s = second.until_s = 50.0;
    first.T_world_map = {3.0, -2.0, 0.7};
    second.T_world_map = {-4.0, 5.0, -2.1};
    second.noise_seed = 2;
    second.drift_rad_per_m = drift_deg_per_m * kDegree;
    return match_maps(build_features(floor->map(first)).value(),
                      build_features(floor->map(second)).value(), {});
  }
};

TEST_P(BentMapsTest, StraightMapsAreMergedAndHaveNoBend) {
  const MatchResult result = match(0.0);
  EXPECT_TRUE(result.accepted()) << result.reason;
  ASSERT_TRUE(result.bend.has_value());
  EXPECT_LT(result.bend->rate_rad_per_m, 0.02 * kDegree);
}

TEST_P(BentMapsTest, MapsBentAgainstEachOtherWaitAndSayByHowMuch) {
  const MatchResult result = match(0.3);
  EXPECT_EQ(result.verdict, Verdict::wait) << result.reason;
  ASSERT_TRUE(result.bend.has_value());
  EXPECT_GT(result.bend->rate_rad_per_m, 0.04 * kDegree);
  EXPECT_LT(result.bend->rate_rad_per_m, 1.5 * kDegree);
  EXPECT_NE(result.reason.find("bent against each other by"), std::string::npos) << result.reason;
}

INSTANTIATE_TEST_SUITE_P(Offices, BentMapsTest, testing::Values(501, 502, 503));

}  // namespace
}  // namespace lifeline::matching
