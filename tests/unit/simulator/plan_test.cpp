#include "agents/sources/simulator/plan.hpp"

#include <gtest/gtest.h>

#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

TEST(FloorPlan, BoundsHoldWallsAndOutline) {
  FloorPlan plan = support::room(4.0, 3.0);
  plan.outline.push_back({{-0.2, -0.2}, {4.2, -0.2}});

  EXPECT_EQ(plan.bounds().min(), Eigen::Vector2d(-0.2, -0.2));
  EXPECT_EQ(plan.bounds().max(), Eigen::Vector2d(4.2, 3.0));
}

TEST(FloorPlan, BoundsOfNothingAreEmpty) {
  EXPECT_TRUE(FloorPlan{}.bounds().isEmpty());
}

TEST(FloorPlan, FloorIsInsideTheLoopAndNotInAPillar) {
  FloorPlan plan = support::room(4.0, 3.0);
  support::add_loop(plan, {{1.0, 1.0}, {1.0, 2.0}, {2.0, 2.0}, {2.0, 1.0}});

  EXPECT_TRUE(plan.is_floor({0.5, 1.5}));
  EXPECT_TRUE(plan.is_floor({3.0, 1.5}));
  EXPECT_FALSE(plan.is_floor({1.5, 1.5}));
  EXPECT_FALSE(plan.is_floor({-0.5, 1.5}));
  EXPECT_FALSE(plan.is_floor({4.5, 1.5}));
  EXPECT_FALSE(plan.is_floor({2.0, 3.5}));
}

TEST(FloorPlan, CornersAtTheSameHeightDoNotConfuseTheEvenOddRule) {
  FloorPlan plan;
  // A saw whose teeth end at y = 1: the line there runs through four corners.
  support::add_loop(plan, {{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}, {3.0, 1.0}, {4.0, 0.0}, {2.0, 3.0}});

  EXPECT_TRUE(plan.is_floor({2.0, 1.0}));
  EXPECT_FALSE(plan.is_floor({0.0, 1.0}));
  EXPECT_FALSE(plan.is_floor({5.0, 1.0}));
}

TEST(FloorPlan, AreaLeavesOutThePillars) {
  FloorPlan plan = support::room(4.0, 3.0);
  EXPECT_DOUBLE_EQ(plan.floor_area_m2(), 12.0);

  support::add_loop(plan, {{1.0, 1.0}, {1.0, 2.0}, {2.0, 2.0}, {2.0, 1.0}});
  EXPECT_DOUBLE_EQ(plan.floor_area_m2(), 11.0);
}

TEST(DistanceTo, IsAcrossTheWallBesideItAndToTheEndBeyondIt) {
  const WallSegment wall{{1.0, 1.0}, {5.0, 1.0}};

  EXPECT_DOUBLE_EQ(distance_to(wall, {3.0, 3.0}), 2.0);
  EXPECT_DOUBLE_EQ(distance_to(wall, {3.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(wall, {8.0, 5.0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(wall, {-2.0, -3.0}), 5.0);
}

TEST(DistanceTo, TakesAWallWithoutLengthAsAPoint) {
  EXPECT_DOUBLE_EQ(distance_to({{1.0, 1.0}, {1.0, 1.0}}, {4.0, 5.0}), 5.0);
}

}  // namespace
}  // namespace lifeline::sources
