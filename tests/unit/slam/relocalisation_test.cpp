#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "agents/helmet_mapper.hpp"
#include "tests/unit/slam/walked_wing.hpp"

namespace lifeline::slam {
namespace {

/// A head that goes on in a map made before.
Walk resumed(const support::FlatWorld& world, const Way& way, TsdGrid layer) {
  Walk walk(world, way);
  walk.slam.resume(std::move(layer));
  return walk;
}

/// Steps from place `first` on until the head is no longer lost; the place.
std::optional<int> walk_until_found(Walk& walk, int first, int last, bool has_attitude = true) {
  for (int k = first; k < last; ++k) {
    const SlamStep step = walk.step(k, Walk::Sees::all, has_attitude);
    if (!step.lost) return k;
    EXPECT_EQ(step.trust_percent, 0);
    EXPECT_EQ(step.pushed, 0);
  }
  return std::nullopt;
}

TEST(Relocalisation, ComesBackAfterTenSecondsCoveredWhileWalkingOn) {
  Walk walk(wing(), through_the_wing());
  const int covered = walk.way.scans() - 160;
  for (int k = 0; k < covered; ++k) ASSERT_FALSE(walk.step(k).lost);
  const TsdGrid before = copy_of(walk.slam.layer());
  SlamStep step;
  for (int k = covered; k < covered + 100; ++k) step = walk.step(k, Walk::Sees::nothing);
  EXPECT_TRUE(step.lost);
  EXPECT_EQ(step.trust_percent, 0);
  const auto found = walk_until_found(walk, covered + 100, covered + 150);
  ASSERT_TRUE(found);
  EXPECT_TRUE(same_cells(walk.slam.layer(), before));
  for (int k = *found + 1; k < walk.way.scans(); ++k) {
    step = walk.step(k);
    EXPECT_LT(walk.off_m(step, k), 0.05) << k;
  }
  EXPECT_EQ(step.verdict, Verdict::accepted);
  EXPECT_EQ(step.trust_percent, 100);
}

TEST(Relocalisation, AShortCoverIsBridgedWithoutBeingLost) {
  Walk walk(wing(), through_the_wing());
  for (int k = 0; k < 200; ++k) (void)walk.step(k);
  for (int k = 200; k < 210; ++k) EXPECT_FALSE(walk.step(k, Walk::Sees::nothing).lost);
  for (int k = 210; k < 300; ++k) {
    const SlamStep step = walk.step(k);
    EXPECT_FALSE(step.lost) << k;
    if (step.verdict == Verdict::accepted) {
      EXPECT_LT(walk.off_m(step, k), 0.06) << k;
    }
    EXPECT_TRUE(k < 240 || step.verdict == Verdict::accepted) << k;
  }
}

TEST(Relocalisation, TheWayFromTheGuessToThePlaceFoundIsNoMotion) {
  // Blind where the way turns back: dead reckoning is 1 m off, and tracking begins anew all the
  // same.
  Walk walk(wing(), through_the_wing());
  for (int k = 0; k < 42; ++k) (void)walk.step(k);
  for (int k = 42; k < 52; ++k) (void)walk.step(k, Walk::Sees::nothing);
  for (int k = 52; k < 200; ++k) {
    const SlamStep step = walk.step(k);
    if (!step.lost && step.verdict == Verdict::accepted) {
      EXPECT_LT(walk.off_m(step, k), 0.06) << k;
    }
  }
  EXPECT_FALSE(walk.slam.is_lost());
}

TEST(Relocalisation, AKidnappedHelmetIsFoundWhereItWasPut) {
  // Carried from the room at one end to the one at the other, lidar covered, attitude unknown.
  Walk walk(wing(), through_the_wing());
  const int taken = 300, put = 55;
  for (int k = 0; k < taken; ++k) (void)walk.step(k);
  EXPECT_GT((walk.way.at(taken).translation() - walk.way.at(put).translation()).norm(), 8.0);
  for (int i = 0; i < 40; ++i) (void)walk.step(taken, Walk::Sees::nothing, false);
  ASSERT_TRUE(walk.slam.is_lost());
  const TsdGrid before = copy_of(walk.slam.layer());
  const auto found = walk_until_found(walk, put, put + 100, false);
  ASSERT_TRUE(found);
  EXPECT_TRUE(same_cells(walk.slam.layer(), before));
  for (int k = *found + 1; k < *found + 60; ++k) {
    EXPECT_LT(walk.off_m(walk.step(k), k), 0.06) << k;
  }
}

TEST(Relocalisation, ARestartedHelmetFindsItselfInTheOldMap) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  for (const int start : {0, 60, 130, 200, 290}) {
    Walk again = resumed(wing(), through_the_wing(), copy_of(map));
    EXPECT_TRUE(again.slam.is_lost());
    const auto found = walk_until_found(again, start, start + 80);
    ASSERT_TRUE(found) << start;
    EXPECT_TRUE(same_cells(again.slam.layer(), map)) << start;
    const SlamStep step = again.step(*found + 1);
    EXPECT_EQ(step.source, PoseSource::map) << start;
    EXPECT_LT(again.off_m(step, *found + 1), 0.06) << start;
  }
}

TEST(Relocalisation, ASearchThatTakesManyScansFindsThePlaceWhereTheHeadIsByThen) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  for (const int start : {0, 130, 200}) {
    Walk again(wing(), through_the_wing());
    SlamConfig config;
    config.relocalise.work_per_scan = 200'000;
    again.slam = TsdSlam(config, kGeometry);
    again.slam.resume(copy_of(map));
    const auto found = walk_until_found(again, start, start + 160);
    ASSERT_TRUE(found) << start;
    EXPECT_TRUE(same_cells(again.slam.layer(), map)) << start;
    EXPECT_LT(again.off_m(again.step(*found + 1), *found + 1), 0.06) << start;
  }
}

TEST(Relocalisation, ALidarThatLooksAheadOnlyIsEnough) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again = resumed(wing(), through_the_wing(), copy_of(map));
  again.lidar = {.beams = 181,
                 .first_angle_rad = -M_PI / 2,
                 .step_rad = M_PI / 180,
                 .max_range_m = 12.0,
                 .noise_m = 0.01};
  const auto found = walk_until_found(again, 100, 250);
  ASSERT_TRUE(found);
  EXPECT_LT(again.off_m(again.step(*found + 1), *found + 1), 0.06);
}

/// Equal to itself turned by half a turn about (0, 0).
support::FlatWorld symmetric_hall() {
  support::FlatWorld world;
  world.add_box(-8.0, -4.0, 8.0, 4.0);
  world.add(-3.0, -4.0, -3.0, 1.0).add(3.0, 4.0, 3.0, -1.0);
  world.add_box(-6.0, 1.0, -5.0, 2.0).add_box(5.0, -2.0, 6.0, -1.0);
  return world;
}
Way through_the_hall() {
  return Way({{-4.0, -2.0},
              {-4.0, 2.5},
              {0.0, 2.0},
              {0.0, -2.0},
              {4.0, -2.5},
              {4.0, 2.0},
              {4.0, -2.5},
              {0.0, -2.0},
              {0.0, 2.0},
              {-4.0, 2.5}});
}

TEST(Relocalisation, InASymmetricPlaceItWaitsForEver) {
  Walk first(symmetric_hall(), through_the_hall());
  Walk again = resumed(symmetric_hall(), through_the_hall(), map_of(first));
  EXPECT_FALSE(walk_until_found(again, 0, again.way.scans()));
}

TEST(Relocalisation, AKnownHeadingTellsTheHalvesOfASymmetricPlaceApart) {
  Walk walk(symmetric_hall(), through_the_hall());
  const int covered = 200;
  for (int k = 0; k < covered; ++k) (void)walk.step(k);
  for (int k = covered; k < covered + 40; ++k) (void)walk.step(k, Walk::Sees::nothing);
  ASSERT_TRUE(walk.slam.is_lost());
  const auto found = walk_until_found(walk, covered + 40, walk.way.scans());
  ASSERT_TRUE(found);
  EXPECT_LT(walk.off_m(walk.step(*found + 1), *found + 1), 0.06);
}

TEST(Relocalisation, InACorridorItWaitsUntilAnEndIsSeen) {
  // 40 m; the lidar sees 6 m, and one end has a niche.
  support::FlatWorld corridor;
  corridor.add(0.0, 0.0, 40.0, 0.0).add(0.0, 2.0, 40.0, 2.0).add(0.0, 0.0, 0.0, 2.0);
  corridor.add_box(37.5, 0.0, 38.0, 0.7).add(40.0, 0.0, 40.0, 2.0);
  Walk walk(corridor, Way({{3.0, 1.1}, {37.0, 1.3}, {25.0, 1.0}, {37.0, 1.4}}));
  walk.lidar.max_range_m = 6.0;
  int k = 0;
  for (; k < 460; ++k) (void)walk.step(k);  // on the way back, at 25 m
  const Walk::Sees nothing = Walk::Sees::nothing;
  for (; k < 500; ++k) (void)walk.step(k, nothing);
  ASSERT_TRUE(walk.slam.is_lost());
  const auto found = walk_until_found(walk, k, walk.way.scans());
  if (found) {
    EXPECT_GT(walk.way.at(*found).x_m, 30.0);
    const SlamStep step = walk.step(*found + 1);
    EXPECT_LT(walk.off_m(step, *found + 1), 0.5);
  }
}

TEST(Relocalisation, OutsideTheKnownMapItStaysLostAndSaysSo) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again = resumed(symmetric_hall(), through_the_hall(), copy_of(map));
  EXPECT_FALSE(walk_until_found(again, 0, again.way.scans()));
  EXPECT_TRUE(same_cells(again.slam.layer(), map));
}

TEST(Relocalisation, APeersMapIsSearchedToo) {
  Walk first(wing(), through_the_wing());
  const TsdGrid map = map_of(first);
  Walk again = resumed(wing(), through_the_wing(), TsdGrid(kGeometry));
  for (const TileIndex tile : map.tiles()) {
    again.slam.set_peer_tile(tile, std::make_shared<const TsdTile>(*map.find(tile)));
  }
  const auto found = walk_until_found(again, 60, 140);
  ASSERT_TRUE(found);
  EXPECT_LT(again.off_m(again.step(*found + 1), *found + 1), 0.06);
}

TEST(Relocalisation, AnEmptyMapLeavesItLost) {
  Walk again = resumed(wing(), through_the_wing(), TsdGrid(kGeometry));
  EXPECT_FALSE(walk_until_found(again, 0, 50));
}

TEST(Relocalisation, WithoutOdometryTheLostPoseStaysWhereItWas) {
  Walk walk(wing(), through_the_wing());
  for (int k = 0; k < 100; ++k) (void)walk.step(k);
  SlamStep lost;
  int k = 100;
  for (; !lost.lost; ++k) lost = walk.step(k, Walk::Sees::nothing);
  SlamStep later;
  for (int i = 0; i < 200; ++i) later = walk.step(k, Walk::Sees::nothing);
  EXPECT_LT((later.T_map_head.translation() - lost.T_map_head.translation()).norm(), 1e-9);
}

TEST(Relocalisation, ALostHelmetPublishesThatItIsLost) {
  SlamConfig config;
  HelmetMapper mapper(config, kGeometry, {});
  const support::FlatWorld world = wing();
  const Way way = through_the_wing();
  for (int k = 0; k < 200; ++k) {
    sensing::RawScan raw;
    raw.stamp = Timestamp(kTenthSecond * k);
    raw.first_angle_rad = -M_PI;
    raw.angle_step_rad = M_PI / 180.0;
    raw.range_max_m = 12.0;
    raw.attitude = sensing::Attitude{0.0, 0.0, way.at(k).yaw_rad};
    for (int i = 0; i < 360; ++i) {
      const double angle_rad = way.at(k).yaw_rad + raw.first_angle_rad + i * raw.angle_step_rad;
      const double range_m = world.range(way.at(k).translation(), angle_rad);
      raw.ranges_m.push_back(k < 150 ? static_cast<float>(range_m) : 0.0F);
    }
    mapper.step(raw);
  }
  EXPECT_EQ(mapper.state().state, wire::AgentState::lost);
  EXPECT_EQ(mapper.state().trust_percent, 0);
  EXPECT_GT(mapper.lost_scans(), 0U);
}

}  // namespace
}  // namespace lifeline::slam
