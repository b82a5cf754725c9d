// The pieces that judge the paper's experiments.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/grid/scan_surface.hpp"
#include "tests/bench/paper/map_error.hpp"
#include "tests/bench/paper/timing_study.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::bench {
namespace {

TEST(MergeOutcome, IsThatOfTheFirstAcceptedAttemptAboveBeta) {
  const std::vector<MergeAttempt> attempts{
      {0.0, 0.5, false, true}, {5.0, 3.0, true, false}, {10.0, 6.0, true, true}};

  const MergeOutcome early = outcome_of(attempts, 0.28), later = outcome_of(attempts, 2.0);
  EXPECT_EQ(early.merged_s, 0.0);
  EXPECT_FALSE(early.merged_rightly);
  EXPECT_FALSE(early.first_is_right);
  EXPECT_EQ(later.merged_s, 10.0);
  EXPECT_TRUE(later.merged_rightly);
  EXPECT_TRUE(later.first_is_right);
  EXPECT_FALSE(outcome_of(attempts, 6.0).tried);
}

TEST(MergeOutcome, NothingAcceptedIsNoMerge) {
  const MergeOutcome outcome = outcome_of({{0.0, 3.0, true, false}}, 2.0);
  EXPECT_TRUE(outcome.tried);
  EXPECT_FALSE(outcome.merged_s.has_value());
}

class MapErrorTest : public ::testing::Test {
 protected:
  static test::SimulatedFloor floor() {
    return test::SimulatedFloor::make(test::repeated_rooms(2, 4.0, 4.0)).value();
  }
  [[nodiscard]] TsdGrid mapped(double until_s) const {
    test::SimulatedView view;
    view.until_s = until_s;
    return floor_.map(view);
  }
  const test::SimulatedFloor floor_ = floor();
  const TsdGrid map_ = mapped(60.0);
};

TEST_F(MapErrorTest, AGoodMapIsNearThePlanAndComplete) {
  const MapError error = map_error(map_, {}, floor_.plan());
  EXPECT_LT(error.wall_m, 0.03);
  EXPECT_LT(error.astray_share, 0.02);
  EXPECT_GT(error.complete_share, 0.85);
}

TEST_F(MapErrorTest, AShiftedMapIsOffByAboutTheShift) {
  const MapError error = map_error(map_, {0.3, 0.3, 0.0}, floor_.plan());
  EXPECT_NEAR(error.wall_m, 0.25, 0.06);  // inner walls have a second face
  EXPECT_GT(error.astray_share, 0.6);
  EXPECT_LT(error.complete_share, 0.5);
}

TEST_F(MapErrorTest, HalfAMapIsAsExactButNotComplete) {
  const TsdGrid half = mapped(4.0);
  const MapError error = map_error(half, {}, floor_.plan());
  EXPECT_LT(error.wall_m, 0.03);
  EXPECT_LT(error.complete_share, map_error(map_, {}, floor_.plan()).complete_share);
}

}  // namespace
}  // namespace lifeline::bench
