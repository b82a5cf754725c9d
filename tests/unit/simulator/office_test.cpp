#include "agents/sources/simulator/office.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/office_furniture.hpp"
#include "agents/sources/simulator/office_layout.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

FloorPlan office(std::uint64_t seed, double width_m = 22.0, double depth_m = 16.0) {
  return generate_office({.seed = seed, .width_m = width_m, .depth_m = depth_m}).value();
}

bool same_walls(const FloorPlan& a, const FloorPlan& b) {
  return std::equal(a.walls.begin(), a.walls.end(), b.walls.begin(), b.walls.end(),
                    [](const auto& u, const auto& v) { return u.a == v.a && u.b == v.b; });
}

TEST(Office, IsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_TRUE(same_walls(office(7), office(7)));
  EXPECT_FALSE(same_walls(office(7), office(8)));
}

TEST(Office, FillsTheSizeAskedForWithOuterWallsOf20Cm) {
  const FloorPlan plan = office(1);

  EXPECT_NEAR((plan.bounds().min() - Eigen::Vector2d(0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((plan.bounds().max() - Eigen::Vector2d(22.0, 16.0)).norm(), 0.0, 1e-9);
  Eigen::AlignedBox2d floor;
  for (const WallSegment& wall : plan.walls) floor.extend(wall.a).extend(wall.b);
  EXPECT_NEAR((floor.min() - Eigen::Vector2d(0.2, 0.2)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((floor.max() - Eigen::Vector2d(21.8, 15.8)).norm(), 0.0, 1e-9);
}

TEST(Office, MostOfItIsFloor) {
  const double share = office(1).floor_area_m2() / (22.0 * 16.0);
  EXPECT_GT(share, 0.7);
  EXPECT_LT(share, 0.95);
}

TEST(Office, DoorwaysAre90CmWideButOneHallMayStandOpen) {
  const FloorPlan plan = office(1);

  ASSERT_GE(plan.doorways.size(), 6U);
  const auto wider = std::count_if(
      plan.doorways.begin(), plan.doorways.end(),
      [](const auto& door) { return std::abs((door.b - door.a).norm() - 0.9) > 1e-9; });
  EXPECT_LE(wider, 1);
  for (const Doorway& door : plan.doorways) EXPECT_TRUE(plan.is_floor(0.5 * (door.a + door.b)));
}

void expect_walls_between(const Box& room, const std::vector<Box>& others, const char* what) {
  for (const Box& other : others) {
    if (&other == &room) continue;
    EXPECT_GE(std::sqrt(room.squaredExteriorDistance(other)), 0.0999) << "to a " << what;
  }
}

TEST(Office, RoomsLieApartByTheThicknessOfAWall) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const OfficeLayout layout =
        lay_out_office(draw.between(10.0, 60.0), draw.between(10.0, 60.0), draw);
    for (const Box& room : layout.rooms) {
      EXPECT_GE(room.sizes().minCoeff(), 2.4);
      expect_walls_between(room, layout.rooms, "room");
      expect_walls_between(room, layout.corridors, "corridor");
    }
  }
}

TEST(Office, RoomsDifferInSize) {
  Draw draw(1);
  const OfficeLayout layout = lay_out_office(22.0, 16.0, draw);
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Box& room : layout.rooms) {
    least = std::min(least, room.sizes().prod());
    most = std::max(most, room.sizes().prod());
  }
  EXPECT_GE(layout.rooms.size(), 8U);
  EXPECT_GT(most, 1.8 * least);
}

TEST(Office, FurnitureLeavesDoorwaysAndPassagesFree) {
  Draw draw(3), furniture_draw(4);
  const OfficeLayout layout = lay_out_office(22.0, 16.0, draw);
  const OfficeFurniture furniture = furnish_office(layout, furniture_draw);

  ASSERT_GE(furniture.boxes.size(), 10U);
  for (std::size_t i = 0; i < furniture.boxes.size(); ++i) {
    for (const Box& opening : layout.openings) {
      EXPECT_GE(std::sqrt(furniture.boxes[i].squaredExteriorDistance(opening)), 0.89);
    }
    for (std::size_t j = i + 1; j < furniture.boxes.size(); ++j) {
      EXPECT_FALSE(furniture.boxes[i].intersects(furniture.boxes[j]));
    }
  }
}

TEST(Office, IsNotItsOwnMirrorImageOrTurnedImage) {
  const FloorPlan plan = office(1);
  const FreeSpace space = FreeSpace::make(plan).value();
  const int columns = space.columns(), rows = space.rows();
  long differ_x = 0, differ_y = 0, differ_turned = 0, floor = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const bool here = space.is_floor({x, y});
      floor += here;
      differ_x += here != space.is_floor({columns - 1 - x, y});
      differ_y += here != space.is_floor({x, rows - 1 - y});
      differ_turned += here != space.is_floor({columns - 1 - x, rows - 1 - y});
    }
  }
  for (const long differ : {differ_x, differ_y, differ_turned}) EXPECT_GT(differ, floor / 10);
}

TEST(Office, RefusesSizesThatMakeNoSense) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double side : {0.0, -5.0, 9.9, 121.0, 1e30, kNaN}) {
    for (const bool width : {true, false}) {
      const auto plan = generate_office(
          {.seed = 1, .width_m = width ? side : 20.0, .depth_m = width ? 20.0 : side});
      ASSERT_FALSE(plan.has_value()) << side;
      EXPECT_EQ(plan.error().code, ErrorCode::wrong_use);
    }
  }
}

}  // namespace
}  // namespace lifeline::sources
