#include "agents/slam/tsd_slam.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "agents/sensing/head_projection.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"
#include "tests/support/poses.hpp"

namespace lifeline::slam {
namespace {

using support::FlatWorld;
using support::scan_of;
using support::small_flat;

constexpr Duration kTenthSecond = std::chrono::milliseconds(100);

/// A walk through the small flat: T_world_head of scan k.
Pose2 walk(int k) {
  const double t = 0.02 * k;
  return {1.2 * std::sin(t), 0.3 + 0.9 * (1.0 - std::cos(t)), 0.6 * std::sin(1.7 * t)};
}

SlamConfig with(Matcher matcher) {
  SlamConfig config;
  config.matcher = matcher;
  return config;
}

/// A head that walks, with an attitude sensor's yaw steps.
class Walker {
 public:
  explicit Walker(SlamConfig config = {}) : slam(config, kGeometry) {}

  SlamStep step(const FlatWorld& world, int k) {
    Scan2 scan = scan_of(world, walk(k), lidar, &random_);
    scan.stamp = Timestamp(kTenthSecond * k);
    return step(std::move(scan), k);
  }
  SlamStep step(Scan2 scan, int k) {
    MotionPrior prior;
    if (k > 0) {
      prior.elapsed = kTenthSecond;
      prior.yaw_step_rad = normalise_angle(walk(k).yaw_rad - walk(k - 1).yaw_rad);
    }
    return slam.step(scan, prior);
  }
  /// The truth in the map's frame, whose origin is the first pose.
  static Pose2 truth(int k) { return walk(0).inverse() * walk(k); }

  support::Lidar lidar{.noise_m = 0.005};
  TsdSlam slam;

 private:
  std::mt19937 random_{11};
};

TEST(TsdSlam, TheFirstPoseIsTheOriginOfTheMap) {
  Walker walker;
  const SlamStep step = walker.step(small_flat(), 0);
  EXPECT_EQ(apart_m(step.T_map_head, {}), 0.0);
  EXPECT_EQ(step.T_map_head.yaw_rad, 0.0);
  EXPECT_EQ(step.verdict, Verdict::accepted);
  EXPECT_EQ(step.source, PoseSource::start);
  EXPECT_TRUE(step.pushed);
  EXPECT_EQ(step.trust_percent, 100);
  EXPECT_GT(walker.slam.layer().tile_count(), 0U);
}

class EachMatcher : public ::testing::TestWithParam<Matcher> {};

TEST_P(EachMatcher, FollowsAWalk) {
  Walker walker(with(GetParam()));
  const double bound_m = GetParam() == Matcher::direct ? 0.02 : 0.08;
  for (int k = 0; k < 150; ++k) {
    const SlamStep step = walker.step(small_flat(), k);
    EXPECT_EQ(step.verdict, Verdict::accepted) << k;
    EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), bound_m) << k;
  }
}

TEST_P(EachMatcher, GivesTheSameBitsForTheSameScans) {
  Walker once(with(GetParam())), again(with(GetParam()));
  for (int k = 0; k < 20; ++k) {
    const SlamStep a = once.step(small_flat(), k), b = again.step(small_flat(), k);
    EXPECT_EQ(a.T_map_head.x_m, b.T_map_head.x_m);
    EXPECT_EQ(a.T_map_head.y_m, b.T_map_head.y_m);
    EXPECT_EQ(a.T_map_head.yaw_rad, b.T_map_head.yaw_rad);
  }
  for (const TileIndex tile : once.slam.layer().tiles()) {
    EXPECT_EQ(*once.slam.layer().find(tile), *again.slam.layer().find(tile));
  }
}

TEST(TsdSlam, AScanThatFoundNoPlaceFindsItOnceTheMapHasGrown) {
  // A room and a round tower at a corridor: from the one nothing of the other can be seen, and
  // nothing in them is alike.
  FlatWorld world;
  world.add(0.0, 0.0, 4.0, 0.0).add(4.0, 0.0, 4.0, 3.0).add(0.0, 0.0, 0.0, 4.0);
  world.add(0.0, 4.0, 10.0, 4.0).add(4.0, 3.0, 7.4, 3.0).add(8.6, 3.0, 10.0, 3.0);
  world.add(10.0, 3.0, 10.0, 4.0).add(7.4, 1.9, 7.4, 3.0).add(8.6, 1.9, 8.6, 3.0);
  const auto tower = [](int side) {
    const double angle_rad = std::numbers::pi / 2 + (side + 0.5) * std::numbers::pi / 6;
    return Eigen::Vector2d(8.0 + 2.5 * std::cos(angle_rad), -0.5 + 2.5 * std::sin(angle_rad));
  };
  for (int side = 0; side < 11; ++side) {  // the twelfth is its door
    const Eigen::Vector2d from = tower(side), to = tower(side + 1);
    world.add(from.x(), from.y(), to.x(), to.y());
  }
  const Pose2 first{1.0, 1.0, 0.0}, other_room{7.6, -1.2, 0.3}, error{0.3, 0.0, 0.0};
  TsdSlam slam({}, kGeometry);
  const auto step = [&](const Pose2& from, const Pose2& to, const Pose2& odometry_error) {
    MotionPrior prior;
    prior.elapsed = kTenthSecond;
    prior.T_previous_now = from.inverse() * to * odometry_error;
    return slam.step(scan_of(world, to), prior);
  };
  (void)slam.step(scan_of(world, first), {});
  ASSERT_NE(step(first, other_room, error).verdict, Verdict::accepted);
  (void)step(other_room, first, error.inverse());
  Pose2 at = first;
  for (const Pose2& next : {Pose2{2.2, 2.0, 0.2}, Pose2{3.4, 3.2, 0.4}, Pose2{4.4, 3.5, 0.1},
                            Pose2{5.6, 3.5, 0.0}, Pose2{6.8, 3.4, -0.4}, Pose2{7.8, 2.8, -0.8},
                            Pose2{8.0, 1.8, -1.2}, Pose2{7.9, 0.6, -1.2}, Pose2{7.8, -0.4, -1.2}}) {
    ASSERT_NE(step(at, next, {}).verdict, Verdict::rejected) << next.x_m;
    at = next;
  }
  slam.settle_all();
  const Pose2 truth = first.inverse() * other_room;
  ASSERT_GT(apart_m(slam.trajectory()[1].pose, truth), 0.2);
  EXPECT_GE(slam.revisit(), 1);
  EXPECT_LT(apart_m(slam.trajectory()[1].pose, truth), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Matchers, EachMatcher,
                         ::testing::Values(Matcher::conventional, Matcher::advanced,
                                           Matcher::direct),
                         [](const auto& param) {
                           return param.param == Matcher::conventional ? "conventional"
                                  : param.param == Matcher::advanced   ? "advanced"
                                                                       : "direct";
                         });

/// Another room altogether: no wall of the small flat stands here.
FlatWorld elsewhere() {
  FlatWorld world;
  world.add_box(-1.1, -0.8, 1.0, 1.9);
  world.add(-0.4, 1.9, 0.2, 1.3);
  return world;
}

TEST(TsdSlam, NothingIsPushedWhileNothingMatches) {
  Walker walker;
  for (int k = 0; k < 30; ++k) (void)walker.step(small_flat(), k);
  (void)walker.slam.take_changed_tiles();
  // A new scene at each scan: neither the map nor the scan before explains it.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> range_m(0.5, 5.0);
  int last_trust = 100;
  for (int k = 30; k < 40; ++k) {
    Scan2 noise;
    for (int i = 0; i < 360; ++i) {
      noise.beams.push_back(support::hit_beam((i - 180) * M_PI / 180, range_m(random)));
    }
    noise.stamp = Timestamp(kTenthSecond * k);
    const SlamStep step = walker.step(noise, k);
    EXPECT_FALSE(step.pushed);
    EXPECT_LT(step.trust_percent, std::max(last_trust, 1));
    EXPECT_NE(step.verdict, Verdict::accepted);
    last_trust = step.trust_percent;
  }
  EXPECT_EQ(last_trust, 0);
  EXPECT_TRUE(walker.slam.take_changed_tiles().empty());
}

TEST(TsdSlam, ComesBackFromAFewBlindScans) {
  Walker walker;
  int k = 0;
  for (; k < 40; ++k) (void)walker.step(small_flat(), k);
  for (; k < 45; ++k) {
    Scan2 blind = scan_of(small_flat(), walk(k));
    for (Beam2& beam : blind.beams) beam.kind = BeamKind::invalid;
    blind.stamp = Timestamp(kTenthSecond * k);
    const SlamStep step = walker.step(blind, k);
    EXPECT_EQ(step.source, PoseSource::dead_reckoning);
    EXPECT_FALSE(step.pushed);
  }
  for (; k < 50; ++k) (void)walker.step(small_flat(), k);
  const SlamStep step = walker.step(small_flat(), k);
  EXPECT_EQ(step.verdict, Verdict::accepted);
  EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.02);
}

TEST(TsdSlam, AnAbruptlyChangedSceneIsCarriedByTheScanBefore) {
  // Paper, section 2.2: the model does not know the new scene; the last scan does.
  Walker walker(with(Matcher::advanced));
  int k = 0;
  for (; k < 30; ++k) (void)walker.step(small_flat(), k);
  (void)walker.step(elsewhere(), k++);  // the doors fell shut all around
  const SlamStep step = walker.step(elsewhere(), k);
  EXPECT_EQ(step.source, PoseSource::scan_to_scan);
  EXPECT_NE(step.verdict, Verdict::rejected);
  EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.1);
}

/// What may come from a bad lidar or driver.
std::vector<Scan2> bad_scans() {
  Scan2 few = scan_of(small_flat(), {});
  for (std::size_t i = 0; i < few.beams.size(); ++i) {
    if (i % 5 != 0) few.beams[i].kind = BeamKind::invalid;
  }
  Scan2 all_same;
  for (int i = 0; i < 360; ++i) all_same.beams.push_back(support::hit_beam(0.01 * i, 0.01));
  Scan2 one;
  one.beams.push_back(support::hit_beam(0.3, 2.0));
  sensing::RawScan nan;
  nan.angle_step_rad = 0.01;
  nan.range_max_m = 30.0;
  nan.ranges_m.assign(360, std::numeric_limits<float>::quiet_NaN());
  return {{}, one, few, all_same, sensing::project_scan(nan, {})};
}

TEST(TsdSlam, BadScansDoNoHarmWheneverTheyCome) {
  for (const int when : {0, 20}) {
    for (const Scan2& bad : bad_scans()) {
      Walker walker;
      int k = 0;
      for (; k < when; ++k) (void)walker.step(small_flat(), k);
      Scan2 scan = bad;
      scan.stamp = Timestamp(kTenthSecond * k);
      (void)walker.step(scan, k++);
      for (; k < when + 30; ++k) {
        const SlamStep step = walker.step(small_flat(), k);
        EXPECT_TRUE(step.T_map_head.is_finite());
        if (when > 0 && k > when + 5) {
          EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.03);
        }
      }
    }
  }
}

TEST(TsdSlam, WaitsForAScanWorthStartingFrom) {
  Walker walker;
  Scan2 blind = scan_of(small_flat(), walk(0));
  for (Beam2& beam : blind.beams) beam.kind = BeamKind::no_return;
  const SlamStep first = walker.step(blind, 0);
  EXPECT_EQ(first.verdict, Verdict::rejected);
  EXPECT_EQ(first.trust_percent, 0);
  EXPECT_EQ(walker.slam.layer().tile_count(), 0U);
  const SlamStep second = walker.step(small_flat(), 1);
  EXPECT_EQ(second.source, PoseSource::start);
  EXPECT_EQ(apart_m(second.T_map_head, {}), 0.0);
}

TEST(TsdSlam, TimeThatStandsOrGoesBackDoesNoHarm) {
  Walker walker;
  for (int k = 0; k < 30; ++k) {
    Scan2 scan = scan_of(small_flat(), walk(k));
    scan.stamp = Timestamp(kTenthSecond * (k % 7 == 3 ? 0 : k));
    MotionPrior prior;
    prior.elapsed = k % 7 == 3 ? -kTenthSecond : Duration{0};
    const SlamStep step = walker.slam.step(scan, prior);
    EXPECT_NE(step.verdict, Verdict::rejected);
    EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.03);
  }
}

TEST(TsdSlam, TheNumberOfBeamsMayChangeFromScanToScan) {
  Walker walker;
  for (int k = 0; k < 40; ++k) {
    walker.lidar.beams = static_cast<std::size_t>(340 + 13 * (k % 5));
    walker.lidar.step_rad = 2.0 * M_PI / static_cast<double>(walker.lidar.beams);
    const SlamStep step = walker.step(small_flat(), k);
    EXPECT_EQ(step.verdict, Verdict::accepted);
    EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.02);
  }
}

TEST(TsdSlam, NamesEachChangedTileOnce) {
  Walker walker;
  (void)walker.step(small_flat(), 0);
  const auto changed = walker.slam.take_changed_tiles();
  EXPECT_EQ(changed, walker.slam.layer().tiles());
  EXPECT_TRUE(walker.slam.take_changed_tiles().empty());
}

TEST(TsdSlam, PeersCellsLeaveNoTraceInTheLayer) {
  Walker alone, together;
  const auto foreign = std::make_shared<TsdTile>();
  foreign->fill({TsdCell::kTsdOne, TsdCell::kWeightOne});
  (void)alone.step(small_flat(), 0);
  (void)together.step(small_flat(), 0);
  together.slam.set_peer_tile({20, 20}, foreign);
  together.slam.set_own_weight(0.7);
  EXPECT_NE(together.slam.working_map().find({20, 20}), nullptr);
  for (int k = 1; k < 10; ++k) {
    (void)alone.step(small_flat(), k);
    (void)together.step(small_flat(), k);
  }
  together.slam.clear_peers();
  EXPECT_EQ(together.slam.working_map().find({20, 20}), nullptr);
  ASSERT_EQ(alone.slam.layer().tiles(), together.slam.layer().tiles());
  for (const TileIndex tile : alone.slam.layer().tiles()) {
    EXPECT_EQ(*alone.slam.layer().find(tile), *together.slam.layer().find(tile));
  }
}

TEST(TsdSlam, TracksThroughRoomsThatOnlyAPeerHasMapped) {
  // The peer has mapped the flat in this helmet's frame; the helmet's own layer holds one scan.
  Walker peer, helmet;
  for (int k = 0; k < 100; ++k) (void)peer.step(small_flat(), k);
  (void)helmet.step(small_flat(), 0);
  for (const TileIndex tile : peer.slam.layer().tiles()) {
    helmet.slam.set_peer_tile(tile, std::make_shared<const TsdTile>(*peer.slam.layer().find(tile)));
  }
  for (int k = 1; k < 100; ++k) {
    const SlamStep step = helmet.step(small_flat(), k);
    EXPECT_EQ(step.verdict, Verdict::accepted);
    EXPECT_LT(apart_m(step.T_map_head, Walker::truth(k)), 0.02);
  }
}

}  // namespace
}  // namespace lifeline::slam
