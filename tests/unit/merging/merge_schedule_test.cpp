#include "coordinator/merging/merge_schedule.hpp"

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using test::layer;

// 600 x 600 cells, as in the paper: beta = 5 % are 18,000 cells.
class MergeScheduleTest : public testing::Test {
 protected:
  static LayerProgress progress(const std::string& agent, std::size_t cells,
                                std::int16_t floor = 0) {
    return {layer(agent, 1, floor), cells, false, cells};
  }
  MergeSchedule schedule_{{.min_explored_percent = 5.0}, 0.05};
};

TEST_F(MergeScheduleTest, ExploredShareCountsAgainstTheMissionArea) {
  EXPECT_DOUBLE_EQ(schedule_.explored_percent(18'000), 5.0);
}

TEST_F(MergeScheduleTest, Equation11MustHoldForBothMaps) {
  EXPECT_FALSE(schedule_.due({progress("alpha", 30'000), progress("bravo", 18'000)}));
  EXPECT_TRUE(schedule_.due({progress("alpha", 30'000), progress("bravo", 18'001)}));
}

TEST_F(MergeScheduleTest, FloorsAreNeverMatchedWithEachOther) {
  EXPECT_FALSE(schedule_.due({progress("alpha", 30'000, 0), progress("bravo", 30'000, 1)}));
}

TEST_F(MergeScheduleTest, APairIsMatchedAgainOnceAMapHasGrown) {
  const auto alpha = progress("alpha", 30'000), bravo = progress("bravo", 30'000);
  schedule_.matched(alpha, bravo);
  EXPECT_FALSE(schedule_.due({alpha, progress("bravo", 33'000)}));
  EXPECT_TRUE(schedule_.due({alpha, progress("bravo", 33'001)}));
}

TEST_F(MergeScheduleTest, FinishedMapsAreMatchedOnceMoreIfTheyChanged) {
  auto alpha = progress("alpha", 30'000), bravo = progress("bravo", 30'000);
  schedule_.matched(alpha, bravo);
  alpha.finished = bravo.finished = true;
  EXPECT_FALSE(schedule_.due({alpha, bravo}));
  bravo.changes += 1;
  EXPECT_TRUE(schedule_.due({alpha, bravo}));
  schedule_.matched(alpha, bravo);
  EXPECT_FALSE(schedule_.due({alpha, bravo}));
}

TEST_F(MergeScheduleTest, ThePairThatWaitedLongestComesFirst) {
  const auto alpha = progress("alpha", 30'000), bravo = progress("bravo", 30'000),
             charlie = progress("charlie", 30'000);
  schedule_.matched(alpha, bravo);
  EXPECT_EQ(schedule_.due({alpha, bravo, charlie}), (LayerPair{alpha.layer, charlie.layer}));
  schedule_.matched(alpha, charlie);
  EXPECT_EQ(schedule_.due({alpha, bravo, charlie}), (LayerPair{bravo.layer, charlie.layer}));
}

}  // namespace
}  // namespace lifeline::merging
