// How a corrected past is taken over, and what is kept for it.
#include <gtest/gtest.h>

#include "agents/slam/tsd_slam.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {
namespace {

using support::scan_of;
using support::small_flat;

/// One keyframe: the first scan.
TsdSlam begun(const SlamConfig& config = {}) {
  TsdSlam slam(config, kGeometry);
  EXPECT_EQ(slam.step(scan_of(small_flat(), {}), {}).verdict, Verdict::accepted);
  return slam;
}

TEST(Correction, TheOldLayerIsGoneBeforeTheNewOneIsDrawn) {
  TsdSlam slam = begun();
  const std::size_t tiles = slam.layer().tile_count();
  ASSERT_GT(tiles, 0U);
  const Pose2 moved{0.5, 0.0, 0.0};
  const bool applied = slam.apply(1, [&] {
    EXPECT_EQ(slam.layer().tile_count(), 0U);
    TsdGrid layer(kGeometry);
    TsdUpdater updater(kGeometry, {});
    (void)updater.push(extract_surface(scan_of(small_flat(), {})), moved, 1.0, layer);
    return MapCorrection{{moved}, std::move(layer)};
  });
  EXPECT_TRUE(applied);
  EXPECT_GT(slam.layer().tile_count(), 0U);
  EXPECT_EQ(slam.trajectory().front().pose.x_m, moved.x_m);
}

TEST(Correction, OneThatCannotBeTakenOverIsNotWorkedOut) {
  TsdSlam slam = begun();
  const std::size_t tiles = slam.layer().tile_count();
  const auto never = [] {
    ADD_FAILURE() << "worked out";
    return MapCorrection{{}, TsdGrid(kGeometry)};
  };
  EXPECT_FALSE(slam.apply(2, never));  // of keyframes that there are not
  EXPECT_FALSE(slam.apply(0, never));
  EXPECT_EQ(slam.layer().tile_count(), tiles);
}

TEST(Correction, ThereAreNoKeyframesWhereNobodyTakesThem) {
  SlamConfig config;
  config.keyframes.hand_over = false;
  TsdSlam slam = begun(config);
  EXPECT_TRUE(slam.take_keyframes().empty());
  EXPECT_FALSE(slam.apply(MapCorrection{{Pose2{}}, TsdGrid(kGeometry)}));
  ASSERT_EQ(slam.trajectory().size(), 1U);
  EXPECT_EQ(begun().take_keyframes().size(), 1U);
}

}  // namespace
}  // namespace lifeline::slam
