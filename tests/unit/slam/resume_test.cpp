// A helmet that restarts moments after it was last known somewhere.

#include <optional>

#include <gtest/gtest.h>

#include "tests/unit/slam/walked_wing.hpp"

namespace lifeline::slam {
namespace {

/// Too long ago for a search round it.
LastPlace last(const Pose2& T_map_head) {
  return {T_map_head, std::chrono::seconds(5)};
}

/// Scans until one is no longer lost, standing at `place` of the way.
std::optional<int> stand_until_found(Walk& walk, int place, int scans) {
  for (int i = 1; i <= scans; ++i) {
    const SlamStep step = walk.step(place);
    if (!step.lost) return i;
    EXPECT_EQ(step.trust_percent, 0);
    EXPECT_EQ(step.pushed, 0);
  }
  return std::nullopt;
}

TEST(Resume, WhoStandsStillIsFoundWhereTheHelmetWasLast) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  for (const int place : {0, 60, 130, 200, 290}) {
    Walk again(wing(), through_the_wing());
    again.slam.resume(copy_of(map), last(again.way.at(0).inverse() * again.way.at(place)));
    EXPECT_TRUE(again.slam.is_lost());
    ASSERT_TRUE(stand_until_found(again, place, 30)) << place;
    EXPECT_TRUE(same_cells(again.slam.layer(), map)) << place;
    EXPECT_LT(again.off_m(again.step(place), place), 0.06) << place;
  }
}

TEST(Resume, WhoStandsStillSomewhereElseWaitsForAWay) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again(wing(), through_the_wing());
  again.slam.resume(copy_of(map), last(again.way.at(0).inverse() * again.way.at(130)));
  EXPECT_FALSE(stand_until_found(again, 200, 100));
  std::optional<int> found;
  for (int k = 200; k < 260 && !found; ++k) {
    if (!again.step(k).lost) found = k;
  }
  ASSERT_TRUE(found);
  EXPECT_LT(again.off_m(again.step(*found + 1), *found + 1), 0.06);
}

TEST(Resume, TheLastPlaceStandsUntilTheTrueOneIsFound) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  const Pose2 before = first.way.at(0).inverse() * first.way.at(60);
  Walk again(wing(), through_the_wing());
  again.slam.resume(copy_of(map), last(before));
  const SlamStep step = again.step(60, Walk::Sees::nothing, false);
  EXPECT_TRUE(step.lost);
  EXPECT_LT((step.T_map_head.translation() - before.translation()).norm(), 1e-9);
}

TEST(Resume, ARestartOfAMomentIsAShortBlindnessAlsoOnTheWayIntoTheUnknown) {
  // Mapped up to place 100 only; the helmet was off for 0.7 s, and walks on.
  Walk first(wing(), through_the_wing());
  for (int k = 0; k <= 100; ++k) (void)first.step(k);
  const Pose2 T_map_start = first.way.at(0).inverse();
  Walk again(wing(), through_the_wing());
  again.slam.resume(copy_of(first.slam.layer()),
                    LastPlace{T_map_start * first.way.at(100), 7 * kTenthSecond});
  for (int k = 107; k < 250; ++k) {
    const SlamStep step = again.step(k);
    EXPECT_FALSE(step.lost) << k;
    if (k <= 110) continue;
    EXPECT_LT(again.off_m(step, k), 0.08) << k;
  }
}

TEST(Resume, KilledForThreeSecondsWhileItWalksOnItIsFoundWithinAMetre) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  for (const int place : {20, 100, 180}) {
    Walk again(wing(), through_the_wing());
    again.slam.resume(copy_of(map), LastPlace{again.way.at(0).inverse() * again.way.at(place),
                                              30 * kTenthSecond});
    EXPECT_TRUE(again.slam.is_lost());
    const Pose2 back = again.way.at(place + 30);
    int k = place + 30;
    while (again.step(k).lost && k < place + 80) ++k;
    EXPECT_LT((again.way.at(k).translation() - back.translation()).norm(), 1.0) << place;
    EXPECT_LT(again.off_m(again.step(k + 1), k + 1), 0.06) << place;
  }
}

TEST(Resume, AfterHalfAMinuteThePlaceWhereItWasLastIsNoEvidence) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again(wing(), through_the_wing());
  again.slam.resume(copy_of(map),
                    LastPlace{again.way.at(0).inverse() * again.way.at(100), 300 * kTenthSecond});
  const Pose2 back = again.way.at(200);
  int k = 200;
  while (again.step(k).lost && k < 290) ++k;
  EXPECT_GE((again.way.at(k).translation() - back.translation()).norm(), 1.9);
}

TEST(Resume, WhoWasNotWhereItWasTakenToBeIsLostAndFoundAsEver) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again(wing(), through_the_wing());
  again.slam.resume(copy_of(map),
                    LastPlace{again.way.at(0).inverse() * again.way.at(10), 5 * kTenthSecond});
  std::optional<int> found;
  for (int k = 290; k < 390 && !found; ++k) {
    const SlamStep step = again.step(k);
    if (!step.lost && step.verdict != Verdict::rejected) found = k;
    EXPECT_TRUE(found || step.pushed == 0) << k;
  }
  ASSERT_TRUE(found);
  EXPECT_LT(again.off_m(again.step(*found + 1), *found + 1), 0.06);
}

TEST(Resume, OfTwoEqualHalvesTheOneWhereItWasLastIsTaken) {
  // Equal to itself turned by half a turn about (0, 0).
  support::FlatWorld hall;
  hall.add_box(-8.0, -4.0, 8.0, 4.0);
  hall.add(-3.0, -4.0, -3.0, 1.0).add(3.0, 4.0, 3.0, -1.0);
  hall.add_box(-6.0, 1.0, -5.0, 2.0).add_box(5.0, -2.0, 6.0, -1.0);
  const Way way({{-4.0, -2.0}, {-4.0, 2.5}, {0.0, 2.0}, {0.0, -2.0}, {4.0, -2.5}, {4.0, 2.0}});
  Walk first(hall, way);
  const TsdGrid map = map_of(first);
  Walk again(hall, way);
  again.slam.resume(copy_of(map), last(way.at(0).inverse() * way.at(20)));
  ASSERT_TRUE(stand_until_found(again, 20, 40));
  EXPECT_LT(again.off_m(again.step(20), 20), 0.06);
  // In the middle, a turn by half is a place of its own, and nothing tells.
  Walk middle(hall, Way({{0.0, 0.0}, {0.0, 0.01}}));
  middle.slam.resume(copy_of(map), last(way.at(0).inverse() * Pose2{0.0, 0.0, 0.0}));
  EXPECT_FALSE(stand_until_found(middle, 0, 60));
}

}  // namespace
}  // namespace lifeline::slam
