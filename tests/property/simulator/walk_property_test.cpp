#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/houseexpo.hpp"
#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/simulator/walk.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

/// What a walk did at its most.
struct Extremes {
  double nearest_wall_m = 1e9;
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double turn_rad_s = 0.0;
  double length_m = 0.0;
  bool crossed_wall = false;
};

Extremes watch(const FloorPlan& plan, const FreeSpace& space, const WalkerNumber& number,
               double seconds) {
  constexpr double kStepS = 0.05;
  Walk walk(space, number);
  Extremes most;
  Pose2 before = walk.pose_at(0.0);
  double speed_before = 0.0;
  for (int i = 1; i * kStepS < seconds; ++i) {
    const Pose2 now = walk.pose_at(i * kStepS);
    const Eigen::Vector2d step = now.translation() - before.translation();
    const double speed = step.norm() / kStepS;
    most.speed_m_s = std::max(most.speed_m_s, speed);
    // Where somebody turns back on the spot, the way between two looks says nothing of the speed.
    if (std::min(speed, speed_before) > 0.3) {
      most.acceleration_m_s2 =
          std::max(most.acceleration_m_s2, std::abs(speed - speed_before) / kStepS);
    }
    most.turn_rad_s =
        std::max(most.turn_rad_s, std::abs(normalise_angle(now.yaw_rad - before.yaw_rad)) / kStepS);
    most.length_m += step.norm();
    for (const WallSegment& wall : plan.walls) {
      if (i % 2 == 0) {
        most.nearest_wall_m = std::min(most.nearest_wall_m, distance_to(wall, now.translation()));
      }
      if (step.norm() > 1e-9) {
        const double hit = ray_to_wall(before.translation(), step.normalized(), wall);
        most.crossed_wall |= hit <= step.norm();
      }
    }
    before = now;
    speed_before = speed;
  }
  return most;
}

void expect_a_persons_walk(const Extremes& most) {
  EXPECT_FALSE(most.crossed_wall);
  EXPECT_GE(most.nearest_wall_m, 0.25);
  EXPECT_LE(most.speed_m_s, WalkLimits::kSpeedMs + 1e-6);
  // In a curve the straight line between two looks takes a little off the speed.
  EXPECT_LE(most.acceleration_m_s2, WalkLimits::kAccelerationMs2 + 0.6);
  EXPECT_LE(most.turn_rad_s, WalkLimits::kTurnRadS + 1e-6);
}

TEST(WalkPropertyTest, InAnyOfficeAWalkKeepsItsDistanceAndItsLimits) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const FloorPlan plan = generate_office({.seed = seed,
                                            .width_m = draw.between(10.0, 36.0),
                                            .depth_m = draw.between(10.0, 26.0)})
                               .value();
    const FreeSpace space = FreeSpace::make(plan).value();
    EXPECT_DOUBLE_EQ(space.kept_distance_m(), 0.35);
    const WalkerNumber number{.seed = seed, .walker = draw.below(3), .walkers = 3};
    const Extremes most = watch(plan, space, number, 90.0);
    expect_a_persons_walk(most);
    EXPECT_GE(most.nearest_wall_m, 0.35);
    EXPECT_GT(most.length_m, 30.0);
  }
}

TEST(WalkPropertyTest, EveryHouseExpoPlanCanBeWalked) {
  const auto files = support::houseexpo_files();
  if (files.empty()) GTEST_SKIP() << "the HouseExpo plans are not here";
  for (std::size_t i = 0; i < files.size(); ++i) {
    SCOPED_TRACE(files[i]);
    const FloorPlan plan = read_houseexpo(files[i]).value();
    const auto space = FreeSpace::make(plan);
    ASSERT_TRUE(space.has_value()) << space.error().text;
    // Every fourth is watched closely, to spare time.
    if (i % 4 != 0) continue;
    const Extremes most = watch(plan, *space, {.seed = 1, .walker = 1, .walkers = 2}, 25.0);
    expect_a_persons_walk(most);
    EXPECT_GT(most.length_m, 5.0);
  }
}

TEST(WalkPropertyTest, EveryRoomOfAnOfficeIsReached) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const FloorPlan plan = generate_office({.seed = seed,
                                            .width_m = draw.between(10.0, 45.0),
                                            .depth_m = draw.between(10.0, 32.0)})
                               .value();
    const FreeSpace space = FreeSpace::make(plan).value();
    for (const Doorway& door : plan.doorways) {
      EXPECT_TRUE(space.is_walkable(space.cell_at(0.5 * (door.a + door.b))));
    }
    std::size_t wide = 0, walkable = 0;
    for (std::size_t i = 0; i < space.size(); ++i) {
      const CellIndex cell = space.cell(i);
      wide += space.is_floor(cell) && space.distance_m(cell) > 0.4;
      walkable += space.is_walkable(cell);
    }
    // All that is wide enough, but for the corner behind a cupboard.
    EXPECT_GT(static_cast<double>(walkable), 0.995 * static_cast<double>(wide));
  }
}

}  // namespace
}  // namespace lifeline::sources
