#include "coordinator/merging/merge_schedule.hpp"

#include <map>

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
    return {layer(agent, 1, floor), cells, false, cells, cells / 10, 0, false};
  }
  [[nodiscard]] std::optional<LayerPair> due(const std::vector<LayerProgress>& layers) const {
    return schedule_.due(layers, now_);
  }
  void matched(const LayerProgress& a, const LayerProgress& b,
               Standing standing = Standing::apart) {
    schedule_.matched(a, b, now_, standing);
    now_ += std::chrono::seconds(5);
  }
  MergeSchedule schedule_{{.min_explored_percent = 5.0}, 0.05};
  SteadyTime now_{std::chrono::hours(1)};
  LayerProgress alpha_ = progress("alpha", 30'000), bravo_ = progress("bravo", 30'000),
                charlie_ = progress("charlie", 30'000);
  LayerPair alpha_bravo_{alpha_.layer, bravo_.layer}, alpha_charlie_{alpha_.layer, charlie_.layer},
      bravo_charlie_{bravo_.layer, charlie_.layer};
};

TEST_F(MergeScheduleTest, ExploredShareCountsAgainstTheMissionArea) {
  EXPECT_DOUBLE_EQ(schedule_.explored_percent(18'000), 5.0);
}

TEST_F(MergeScheduleTest, Equation11MustHoldForBothMaps) {
  EXPECT_FALSE(due({alpha_, progress("bravo", 18'000)}));
  EXPECT_TRUE(due({alpha_, progress("bravo", 18'001)}));
}

TEST_F(MergeScheduleTest, FloorsAreNeverMatchedWithEachOther) {
  EXPECT_FALSE(due({alpha_, progress("bravo", 30'000, 1)}));
}

TEST_F(MergeScheduleTest, APairIsMatchedAgainOnceAMapHasGrown) {
  matched(alpha_, bravo_);
  EXPECT_FALSE(due({alpha_, progress("bravo", 33'000)}));
  EXPECT_TRUE(due({alpha_, progress("bravo", 33'001)}));
}

TEST_F(MergeScheduleTest, AMapThatWasCorrectedIsMatchedAgainThoughItDidNotGrow) {
  matched(alpha_, bravo_, Standing::merged);
  bravo_.changes += 200;
  bravo_.revised_cells = bravo_.wall_cells / 50;
  EXPECT_FALSE(due({alpha_, bravo_})) << "many tiles, but the walls stand where they stood";
  bravo_.revised_cells = bravo_.wall_cells / 20;
  EXPECT_TRUE(due({alpha_, bravo_}));
  matched(alpha_, bravo_, Standing::merged);
  EXPECT_FALSE(due({alpha_, bravo_}));
}

TEST_F(MergeScheduleTest, OnePairIsMatchedNoMoreThanOnceASecond) {
  schedule_.matched(alpha_, bravo_, now_, Standing::merged);
  bravo_.revised_cells = bravo_.wall_cells;
  EXPECT_FALSE(due({alpha_, bravo_}));
  EXPECT_TRUE(schedule_.pending({alpha_, bravo_})) << "but it is not forgotten";
  now_ += std::chrono::seconds(1);
  EXPECT_TRUE(due({alpha_, bravo_}));
}

TEST_F(MergeScheduleTest, MapsAreMatchedOnceMoreWhenBothAreFinishedAndWhenTheyChangeStill) {
  matched(alpha_, bravo_);
  alpha_.finished = true;
  EXPECT_FALSE(due({alpha_, bravo_}));
  bravo_.finished = true;
  EXPECT_TRUE(due({alpha_, bravo_}));
  matched(alpha_, bravo_);
  EXPECT_FALSE(due({alpha_, bravo_}));
  bravo_.changes += 1;
  EXPECT_TRUE(due({alpha_, bravo_}));
  matched(alpha_, bravo_);
  EXPECT_FALSE(due({alpha_, bravo_}));
}

TEST_F(MergeScheduleTest, ADoubtedMergeGetsASecondMatchAtTheNextChange) {
  matched(alpha_, bravo_, Standing::doubted);
  EXPECT_FALSE(due({alpha_, bravo_}));
  alpha_.changes += 1;
  EXPECT_TRUE(due({alpha_, bravo_}));
}

TEST_F(MergeScheduleTest, ADoubtedMergeGetsOneMoreMatchOnMapsThatDoNotChange) {
  matched(alpha_, bravo_, Standing::doubted);
  alpha_.quiet = bravo_.quiet = true;
  EXPECT_TRUE(due({alpha_, bravo_}));
  matched(alpha_, bravo_, Standing::doubted);
  EXPECT_FALSE(due({alpha_, bravo_}));
}

TEST_F(MergeScheduleTest, PairsThatWereNeverMatchedComeFirst) {
  matched(alpha_, bravo_);
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_charlie_);
  matched(alpha_, charlie_);
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), bravo_charlie_);
}

TEST_F(MergeScheduleTest, AMergeThatMayDoHarmComesBeforeThem) {
  matched(alpha_, bravo_, Standing::merged);
  alpha_.revised_cells = alpha_.wall_cells;
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_bravo_);
}

TEST_F(MergeScheduleTest, PairsApartComeBeforeMergedOnes) {
  matched(alpha_, bravo_, Standing::merged);
  matched(alpha_, charlie_, Standing::apart);
  matched(bravo_, charlie_, Standing::apart);
  // The next match is the fair one: let it pass.
  matched(bravo_, charlie_, Standing::apart);
  for (LayerProgress* grown : {&alpha_, &bravo_, &charlie_}) grown->known_cells = 40'000;
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_charlie_);
}

TEST_F(MergeScheduleTest, AMergeThatWasConfirmedThriceNeedsTwiceTheGrowth) {
  for (int i = 0; i < 3; ++i) matched(alpha_, bravo_, Standing::merged);
  EXPECT_FALSE(due({alpha_, progress("bravo", 35'000)}));
  EXPECT_TRUE(due({alpha_, progress("bravo", 36'001)}));
}

TEST_F(MergeScheduleTest, WhatNothingJoinsYetComesBeforePairsOfOneGroup) {
  alpha_.group = bravo_.group = 0;
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_charlie_);
  matched(alpha_, charlie_);
  matched(bravo_, charlie_);
  charlie_.known_cells = 40'000;  // apart and grown: looked at again before alpha and bravo
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_charlie_);
  matched(alpha_, charlie_);
  matched(bravo_, charlie_);
  EXPECT_EQ(due({alpha_, bravo_, charlie_}), alpha_bravo_) << "their turn comes at last";
}

TEST_F(MergeScheduleTest, TwoGroupsAreBroughtTogetherFirst) {
  LayerProgress delta = progress("delta", 30'000);
  alpha_.group = bravo_.group = 0;
  charlie_.group = delta.group = 1;
  EXPECT_EQ(due({alpha_, bravo_, charlie_, delta}), alpha_charlie_);
}

TEST_F(MergeScheduleTest, APairThatSomebodyAsksForIsMatchedUnchanged) {
  matched(alpha_, bravo_);
  EXPECT_EQ(schedule_.due({alpha_, bravo_}, now_, {alpha_bravo_}), alpha_bravo_);
}

TEST_F(MergeScheduleTest, NobodyStarvesWhileOnePairIsCorrectedAllTheTime) {
  matched(alpha_, bravo_, Standing::merged);
  matched(alpha_, charlie_, Standing::merged);
  matched(bravo_, charlie_, Standing::merged);
  std::map<LayerPair, int> served;
  for (int turn = 0; turn < 40; ++turn) {
    alpha_.revised_cells += alpha_.wall_cells;  // harm to both of alpha's merges
    bravo_.known_cells += 6'000;
    charlie_.known_cells += 6'000;
    const auto pair = due({alpha_, bravo_, charlie_});
    ASSERT_TRUE(pair);
    ++served[*pair];
    matched(pair->a == alpha_.layer ? alpha_ : bravo_,
            pair->b == charlie_.layer ? charlie_ : bravo_, Standing::merged);
  }
  EXPECT_GE(served[bravo_charlie_], 5);
}

}  // namespace
}  // namespace lifeline::merging
