#include "agents/sources/simulator/ray_scene.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector2d towards(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle)};
}

TEST(RayToWall, MeasuresAlongTheRay) {
  const WallSegment wall{{2.0, -1.0}, {2.0, 1.0}};

  EXPECT_DOUBLE_EQ(ray_to_wall({0.0, 0.0}, {1.0, 0.0}, wall), 2.0);
  EXPECT_NEAR(ray_to_wall({0.0, 0.0}, towards(20.0), wall),
              2.0 / std::cos(20.0 * std::numbers::pi / 180.0), 1e-12);
}

TEST(RayToWall, MissesWhatIsBesideBehindOrEdgeOn) {
  const WallSegment wall{{2.0, -1.0}, {2.0, 1.0}};

  EXPECT_EQ(ray_to_wall({0.0, 0.0}, towards(30.0), wall), kInfinity);
  EXPECT_EQ(ray_to_wall({0.0, 0.0}, {-1.0, 0.0}, wall), kInfinity);
  EXPECT_EQ(ray_to_wall({2.0, -3.0}, {0.0, 1.0}, wall), kInfinity);
}

TEST(RayToWall, DoesNotCareWhichWayTheWallRuns) {
  const Eigen::Vector2d origin(0.3, 0.1), direction = towards(10.0);
  const WallSegment wall{{2.0, -1.0}, {2.2, 1.3}};

  EXPECT_DOUBLE_EQ(ray_to_wall(origin, direction, wall),
                   ray_to_wall(origin, direction, {wall.b, wall.a}));
}

TEST(RayScene, SeesTheRoomFromInside) {
  const FloorPlan plan = support::room(6.0, 4.0);
  const RayScene scene(plan.walls);

  EXPECT_DOUBLE_EQ(scene.cast({2.0, 1.0}, {1.0, 0.0}, 25.0), 4.0);
  EXPECT_DOUBLE_EQ(scene.cast({2.0, 1.0}, {-1.0, 0.0}, 25.0), 2.0);
  EXPECT_DOUBLE_EQ(scene.cast({2.0, 1.0}, {0.0, 1.0}, 25.0), 3.0);
  EXPECT_DOUBLE_EQ(scene.cast({2.0, 1.0}, {0.0, -1.0}, 25.0), 1.0);
  EXPECT_NEAR(scene.cast({2.0, 1.0}, towards(45.0), 25.0), 3.0 * std::numbers::sqrt2, 1e-12);
}

TEST(RayScene, SeesTheRoomFromOutside) {
  const FloorPlan plan = support::room(6.0, 4.0);
  const RayScene scene(plan.walls);

  EXPECT_NEAR(scene.cast({-3.0, 2.0}, {1.0, 0.0}, 25.0), 3.0, 1e-12);
  EXPECT_NEAR(scene.cast({3.0, 9.0}, {0.0, -1.0}, 25.0), 5.0, 1e-12);
  EXPECT_EQ(scene.cast({-3.0, 2.0}, {-1.0, 0.0}, 25.0), kInfinity);
  EXPECT_EQ(scene.cast({-3.0, 9.0}, {1.0, 0.0}, 25.0), kInfinity);
}

TEST(RayScene, SeesNothingBeyondItsRange) {
  const FloorPlan plan = support::room(6.0, 4.0);
  const RayScene scene(plan.walls);

  EXPECT_EQ(scene.cast({2.0, 1.0}, {1.0, 0.0}, 3.99), kInfinity);
  EXPECT_DOUBLE_EQ(scene.cast({2.0, 1.0}, {1.0, 0.0}, 4.0), 4.0);
}

TEST(RayScene, LooksThroughADoorway) {
  const FloorPlan plan = support::two_rooms(1.0);
  const RayScene scene(plan.walls);

  EXPECT_DOUBLE_EQ(scene.cast({1.0, 2.0}, {1.0, 0.0}, 25.0), 7.1);
  EXPECT_DOUBLE_EQ(scene.cast({1.0, 1.0}, {1.0, 0.0}, 25.0), 3.0);
}

TEST(RayScene, NoRaySlipsThroughACorner) {
  const FloorPlan plan = support::two_rooms(1.0);
  const RayScene scene(plan.walls);
  for (int x = 1; x < 40; ++x) {
    const Eigen::Vector2d origin(0.1 * x, 1.7);
    for (const WallSegment& wall : plan.walls) {
      const Eigen::Vector2d direction = (wall.a - origin).normalized();
      const double range = scene.cast(origin, direction, 25.0);
      EXPECT_LE(range, (wall.a - origin).norm() + 1e-6);
    }
  }
}

TEST(RayScene, WithoutWallsThereIsNothingToSee) {
  const RayScene scene(std::vector<WallSegment>{});
  EXPECT_EQ(scene.cast({0.0, 0.0}, {1.0, 0.0}, 25.0), kInfinity);
}

TEST(RayScene, ASingleWallIsSeenFromBothSides) {
  const std::vector<WallSegment> wall{{{0.0, 5.0}, {100.0, 5.0}}};
  const RayScene scene(wall);

  EXPECT_DOUBLE_EQ(scene.cast({50.0, 2.0}, {0.0, 1.0}, 25.0), 3.0);
  EXPECT_DOUBLE_EQ(scene.cast({50.0, 9.0}, {0.0, -1.0}, 25.0), 4.0);
}

TEST(RayScene, HoldsAWideFewWalledPlaceWithoutMillionsOfFields) {
  const std::vector<WallSegment> walls{{{-4000.0, -4000.0}, {-4000.0, 4000.0}},
                                       {{4000.0, 4000.0}, {4000.0, -4000.0}}};
  const RayScene scene(walls);
  EXPECT_NEAR(scene.cast({0.0, 0.0}, {1.0, 0.0}, 5000.0), 4000.0, 1e-9);
}

}  // namespace
}  // namespace lifeline::sources
