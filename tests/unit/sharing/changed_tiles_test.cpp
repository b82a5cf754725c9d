#include "agents/sharing/changed_tiles.hpp"

#include <chrono>

#include <gtest/gtest.h>

#include "common/wire/coarse_cells.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kCell_m2 = 0.0025;
const TileIndex kTile{3, -2};

using Cells = std::shared_ptr<const QuantisedTile>;

/// Free space in the first `rows` rows.
QuantisedTile free_rows(int rows) {
  QuantisedTile tile{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows * kTileSide); ++i) tile[i] = {127, 9};
  return tile;
}

/// `tile` with a closed door: a wall two cells deep and `length` long, across free space.
QuantisedTile with_wall(QuantisedTile tile, int length) {
  for (int x = 10; x < 10 + length; ++x) {
    for (int y = 4; y < 6; ++y) tile[offset_in_tile({x, y})] = {-20, 9};
  }
  return tile;
}

class ChangedTilesTest : public testing::Test {
 protected:
  void put(const QuantisedTile& tile, TileIndex at = kTile) {
    changed_.put({{at, std::make_shared<const QuantisedTile>(tile)}});
  }

  /// Time goes on, and a link without bounds takes all that is due. What went.
  std::vector<TileIndex> wait(Duration time) {
    std::vector<TileIndex> went;
    for (Duration passed{}; passed < time; passed += milliseconds(100)) {
      now_ += milliseconds(100);
      for (const ChangedTiles::Due& due : changed_.due(now_, kCell_m2)) {
        changed_.set_sent(due.tile, due.cells, now_);
        sent_ = due.cells;
        went.push_back(due.tile);
      }
    }
    return went;
  }

  /// Something comes in now and then: nobody is at the end.
  std::vector<TileIndex> wait_busy(Duration time) {
    std::vector<TileIndex> went;
    for (Duration passed{}; passed < time; passed += seconds(5)) {
      changed_.put({{TileIndex{99, 99}, std::make_shared<const QuantisedTile>()}});
      for (const TileIndex tile : wait(seconds(5))) went.push_back(tile);
    }
    return went;
  }

  HoldBackConfig config_;
  ChangedTiles changed_{config_, true};
  SteadyTime now_{seconds(1000)};
  Cells sent_;
};

TEST_F(ChangedTilesTest, ANewTileGoesTheSoonerTheMoreOfItIsKnown) {
  put(free_rows(64));  // 10.24 m2
  EXPECT_TRUE(wait(milliseconds(800)).empty());
  EXPECT_EQ(wait(milliseconds(700)).size(), 1U);
  put(free_rows(8), {0, 0});  // 1.28 m2
  EXPECT_TRUE(wait_busy(seconds(5)).empty());
  EXPECT_EQ(wait_busy(seconds(5)).size(), 1U);
}

TEST_F(ChangedTilesTest, ATileThatGrowsGoesOnceMoreAfterAWhile) {
  put(free_rows(20));
  ASSERT_EQ(wait(seconds(10)).size(), 1U);
  put(free_rows(40));  // 3.2 m2 more
  EXPECT_TRUE(wait_busy(seconds(15)).empty());
  EXPECT_EQ(wait_busy(seconds(10)).size(), 1U);
  EXPECT_EQ(changed_.waiting(), 0U);
}

TEST_F(ChangedTilesTest, EachRevisionMakesItMorePatientUpToFourTimes) {
  std::vector<double> took_s;
  for (int rows = 4; rows <= 64; rows += 12) {  // 1.92 m2 more each time
    put(free_rows(rows));
    const SteadyTime since = now_;
    while (wait_busy(seconds(5)).empty()) ASSERT_LT(now_ - since, seconds(700));
    took_s.push_back(to_seconds(now_ - since));
  }
  EXPECT_GT(took_s[2], 1.5 * took_s[1]);
  EXPECT_GT(took_s[3], 1.5 * took_s[2]);
  EXPECT_NEAR(took_s[4], took_s[3], 5.0);
}

TEST_F(ChangedTilesTest, AWallThatWavesByLessThanACellIsNotSentAgain) {
  put(support::wall_tile(0.3));
  ASSERT_EQ(wait(seconds(10)).size(), 1U);
  for (int i = 0; i < 20; ++i) {
    put(support::wall_tile(0.3, i % 2 == 0 ? 0.1 : -0.1));
    EXPECT_TRUE(wait_busy(seconds(100)).empty());
  }
  changed_.set_finished(true);
  EXPECT_TRUE(wait(seconds(5)).empty());
}

TEST_F(ChangedTilesTest, AWallThatMovedIsSentAgain) {
  put(support::wall_tile(0.3));
  ASSERT_EQ(wait(seconds(10)).size(), 1U);
  put(support::wall_tile(0.3, 4.0));
  EXPECT_EQ(wait_busy(seconds(100)).size(), 1U);
}

TEST_F(ChangedTilesTest, ADoorThatClosedIsSentThoughItIsAFewCells) {
  put(free_rows(64));
  ASSERT_EQ(wait(seconds(10)).size(), 1U);
  put(with_wall(free_rows(64), 20));  // a metre
  EXPECT_EQ(wait_busy(config_.longest + seconds(5)).size(), 1U);
  EXPECT_EQ((*sent_)[offset_in_tile({15, 4})].tsd, -10);
}

TEST_F(ChangedTilesTest, AFewCellsNeverGo) {
  put(free_rows(20));
  ASSERT_EQ(wait(seconds(10)).size(), 1U);
  put(free_rows(21));  // 0.16 m2
  EXPECT_TRUE(wait_busy(2 * config_.longest).empty());
  changed_.set_finished(true);
  EXPECT_TRUE(wait(seconds(5)).empty());
  EXPECT_EQ(changed_.waiting(), 0U);
}

TEST_F(ChangedTilesTest, AtTheEndAllThatIsLeftGoesAtOnce) {
  put(free_rows(20));
  put(free_rows(1), {7, 7});
  ASSERT_EQ(wait(seconds(5)).size(), 1U);
  put(free_rows(30));
  ASSERT_TRUE(wait(milliseconds(300)).empty());
  changed_.set_finished(true);
  EXPECT_EQ(wait(milliseconds(600)).size(), 2U);
  EXPECT_EQ(changed_.waiting(), 0U);
}

TEST_F(ChangedTilesTest, WhenNothingComesAnyMoreWhatIsLeftGoes) {
  put(free_rows(20));
  ASSERT_EQ(wait(seconds(5)).size(), 1U);
  put(free_rows(24));
  EXPECT_TRUE(wait(config_.quiet_after - seconds(1)).empty());
  EXPECT_EQ(wait(seconds(2)).size(), 1U);
}

TEST_F(ChangedTilesTest, TilesThatNobodyHasGoFirstThenThoseThatDifferMost) {
  const TileIndex little{0, 0}, much{1, 0}, fresh{2, 0};
  put(free_rows(10), little);
  put(free_rows(10), much);
  ASSERT_EQ(wait(seconds(10)).size(), 2U);
  put(free_rows(20), little);
  put(free_rows(30), much);
  put(free_rows(2), fresh);
  changed_.set_finished(true);
  EXPECT_EQ(wait(milliseconds(600)), (std::vector{fresh, much, little}));
}

TEST_F(ChangedTilesTest, WhatWentIsWhatACoarseReaderOfTheNewestStateWouldHold) {
  std::mt19937 random(9);
  for (int i = 0; i < 10; ++i) {
    const QuantisedTile newest = support::random_tile(random, 0.1 * i + 0.05);
    const Cells before = sent_;
    put(newest);
    changed_.set_finished(true);
    ASSERT_EQ(wait(seconds(1)).size(), 1U) << i;
    EXPECT_EQ(*sent_, wire::coarse(newest, before.get())) << i;
  }
}

TEST(ForBudget, ALinkTwoHundredTimesAsWideHasNoneWaitAndANarrowerOneNoneLonger) {
  const HoldBackConfig made_for_radio;
  const HoldBackConfig wired = for_budget(made_for_radio, 50e6);
  EXPECT_EQ(wired.min_interval, milliseconds(50));
  EXPECT_EQ(wired.new_m2_s, 0.0);
  EXPECT_EQ(wired.changed_m2_s, 0.0);
  EXPECT_NEAR(for_budget(made_for_radio, 2.56e6).changed_m2_s, 0.1 * made_for_radio.changed_m2_s,
              1e-9);
  EXPECT_LT(wired.least_m2, 2.0 * kCell_m2);
  for (const double budget_bit_s : {8'000.0, 256'000.0}) {
    const HoldBackConfig same = for_budget(made_for_radio, budget_bit_s);
    EXPECT_EQ(same.min_interval, made_for_radio.min_interval);
    EXPECT_EQ(same.new_m2_s, made_for_radio.new_m2_s);
    EXPECT_EQ(same.changed_m2_s, made_for_radio.changed_m2_s);
    EXPECT_EQ(same.least_m2, made_for_radio.least_m2);
  }
}

TEST_F(ChangedTilesTest, InALargeTeamTheRevisionsOfATileAreFurtherApart) {
  config_.new_m2_s = config_.changed_m2_s = config_.least_m2 = 0.0;
  changed_ = ChangedTiles(config_, true);
  changed_.set_least_interval(seconds(2));
  std::size_t went = 0;
  for (int rows = 1; rows <= 20; ++rows) {  // 10 s, and something new each half second
    put(free_rows(rows));
    went += wait(milliseconds(500)).size();
  }
  EXPECT_GE(went, 4U);
  EXPECT_LE(went, 6U);
  went = wait(seconds(21)).size();  // the last state goes all the same
  EXPECT_LE(went, 1U);
  EXPECT_EQ(changed_.waiting(), 0U);
}

}  // namespace
}  // namespace lifeline::sharing
