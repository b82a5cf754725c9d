#include "agents/sources/simulator/free_space.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "agents/sources/simulator/office.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using ::testing::HasSubstr;

double walkable_m2(const FreeSpace& space) {
  std::size_t cells = 0;
  for (std::size_t i = 0; i < space.size(); ++i) cells += space.is_walkable(space.cell(i));
  return static_cast<double>(cells) * FreeSpace::kCellM * FreeSpace::kCellM;
}

TEST(FreeSpace, FloorAgreesWithThePlan) {
  const FloorPlan plan = generate_office({}).value();
  const FreeSpace space = FreeSpace::make(plan).value();
  for (std::size_t i = 0; i < space.size(); i += 7) {
    const CellIndex cell = space.cell(i);
    EXPECT_EQ(space.is_floor(cell), plan.is_floor(space.centre(cell)));
  }
}

TEST(FreeSpace, DistancesAreThoseToTheNearestWall) {
  const FloorPlan plan = support::two_rooms(0.9);
  const FreeSpace space = FreeSpace::make(plan).value();
  for (std::size_t i = 0; i < space.size(); i += 5) {
    double nearest = FreeSpace::kFarM;
    for (const WallSegment& wall : plan.walls) {
      nearest = std::min(nearest, distance_to(wall, space.centre(space.cell(i))));
    }
    EXPECT_NEAR(space.distance_m(space.cell(i)), nearest, 1e-6);
  }
}

TEST(FreeSpace, CellsAndPlacesAreInverse) {
  const FreeSpace space = FreeSpace::make(support::room(3.0, 3.0)).value();
  for (std::size_t i = 0; i < space.size(); ++i) {
    EXPECT_EQ(space.index(space.cell(i)), i);
    EXPECT_EQ(space.cell_at(space.centre(space.cell(i))), space.cell(i));
  }
  EXPECT_FALSE(space.contains({-1, 0}));
  EXPECT_FALSE(space.contains({0, space.rows()}));
  EXPECT_FALSE(space.is_floor({-1, -1}));
  EXPECT_FALSE(space.is_walkable({space.columns(), 0}));
}

TEST(FreeSpace, APersonKeeps35CmFromTheWalls) {
  const FreeSpace space = FreeSpace::make(support::room(4.0, 3.0)).value();

  EXPECT_DOUBLE_EQ(space.kept_distance_m(), 0.35);
  EXPECT_NEAR(walkable_m2(space), 3.2 * 2.2, 0.2);
  EXPECT_FALSE(space.is_walkable(space.cell_at({0.36, 1.5})));
  EXPECT_TRUE(space.is_walkable(space.cell_at({0.45, 1.5})));
}

TEST(FreeSpace, ANarrowDoorwayIsPassedWithLessDistance) {
  EXPECT_DOUBLE_EQ(FreeSpace::make(support::two_rooms(0.90)).value().kept_distance_m(), 0.35);
  EXPECT_DOUBLE_EQ(FreeSpace::make(support::two_rooms(0.75)).value().kept_distance_m(), 0.30);
  EXPECT_DOUBLE_EQ(FreeSpace::make(support::two_rooms(0.65)).value().kept_distance_m(), 0.25);
}

TEST(FreeSpace, OnlyTheLargestPieceIsWalkable) {
  FloorPlan plan = support::room(4.0, 4.0);
  support::add_loop(plan, {{10.0, 0.0}, {13.0, 0.0}, {13.0, 3.0}, {10.0, 3.0}});
  const FreeSpace space = FreeSpace::make(plan).value();

  EXPECT_TRUE(space.is_walkable(space.cell_at({2.0, 2.0})));
  EXPECT_TRUE(space.is_floor(space.cell_at({11.5, 1.5})));
  EXPECT_FALSE(space.is_walkable(space.cell_at({11.5, 1.5})));
}

TEST(FreeSpace, TheInsideOfAWidePillarIsNotWalkable) {
  FloorPlan plan = support::room(8.0, 8.0);
  support::add_loop(plan, {{2.0, 2.0}, {2.0, 6.0}, {6.0, 6.0}, {6.0, 2.0}});
  const FreeSpace space = FreeSpace::make(plan).value();

  EXPECT_FALSE(space.is_floor(space.cell_at({4.0, 4.0})));
  EXPECT_FALSE(space.is_walkable(space.cell_at({4.0, 4.0})));
  EXPECT_TRUE(space.is_walkable(space.cell_at({1.0, 1.0})));
}

TEST(FreeSpace, GoesStraightOnlyWhereThereIsRoom) {
  const FreeSpace space = FreeSpace::make(support::two_rooms(0.9)).value();

  EXPECT_TRUE(space.can_go({1.0, 2.0}, {7.0, 2.0}));
  EXPECT_FALSE(space.can_go({1.0, 1.0}, {7.0, 1.0}));
  EXPECT_TRUE(space.can_go({1.0, 1.0}, {3.0, 3.0}));
  EXPECT_FALSE(space.can_go({1.0, 2.0}, {7.0, 2.0}, 0.6)) << "the doorway is only 0.9 m wide";
  EXPECT_FALSE(space.can_go({1.0, 2.0}, {-3.0, 2.0}));
}

TEST(FreeSpace, SeesThroughTheDoorwayAndNotThroughTheWall) {
  const FreeSpace space = FreeSpace::make(support::two_rooms(0.9)).value();
  const auto at = [&](double x, double y) { return space.cell_at({x, y}); };

  EXPECT_TRUE(space.can_see(at(1.0, 2.0), at(7.0, 2.0)));
  EXPECT_TRUE(space.can_see(at(7.0, 2.0), at(1.0, 2.0)));
  EXPECT_FALSE(space.can_see(at(1.0, 1.0), at(7.0, 1.0)));
  EXPECT_FALSE(space.can_see(at(3.0, 0.5), at(5.0, 0.5)));
  EXPECT_TRUE(space.can_see(at(1.0, 1.0), at(1.0, 1.0)));
}

TEST(FreeSpace, RefusesAPlanWithoutRoomToWalk) {
  const auto slot = FreeSpace::make(support::room(20.0, 0.4));
  ASSERT_FALSE(slot.has_value());
  EXPECT_EQ(slot.error().code, ErrorCode::bad_data);
  EXPECT_THAT(slot.error().text, HasSubstr("no floor that is wide enough"));

  const auto nothing =
      FreeSpace::make({.name = "empty", .walls = {}, .outline = {}, .doorways = {}});
  ASSERT_FALSE(nothing.has_value());
  EXPECT_THAT(nothing.error().text, HasSubstr("has no walls"));
}

}  // namespace
}  // namespace lifeline::sources
