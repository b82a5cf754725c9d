#include "agents/hud/way_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/hud_rooms.hpp"

namespace lifeline::hud {
namespace {

using Eigen::Vector2d;

HudMap map_of(const std::vector<std::string>& plan) {
  HudMap map(0.05);
  map.put(test::plan_tiles(plan));
  map.refresh();
  return map;
}

/// Every 2 cm of the path, by the cells that it crosses.
bool crosses(const HudMap& map, const Path& path, Occupancy what) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2d step = path[i] - path[i - 1];
    for (double t = 0.0; t <= 1.0; t += 0.02 / std::max(0.02, step.norm())) {
      const Vector2d p_m = path[i - 1] + t * step;
      if (map.at(cell_at(p_m, map.cell_size_m())) == what) return true;
    }
  }
  return false;
}

const std::vector<std::string> kTwoRooms{
    "#############",  //
    "#.....#.....#",  //
    "#.....#.....#",  //
    "#...........#",  //
    "#...........#",  //
    "#.....#.....#",  //
    "#############",  //
};

TEST(WayOut, LeadsThroughTheDoorAndNoWall) {
  const HudMap map = map_of(kTwoRooms);
  const auto path = find_free_way(map, {}, {1.0, 2.6}, {5.5, 2.6});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->front(), Vector2d(1.0, 2.6));
  EXPECT_EQ(path->back(), Vector2d(5.5, 2.6));
  EXPECT_FALSE(crosses(map, *path, Occupancy::occupied));
  EXPECT_FALSE(crosses(map, *path, Occupancy::unknown));
  EXPECT_GT(length_of(*path), 4.8);
  EXPECT_LT(length_of(*path), 6.5) << "not much longer than need be";
}

TEST(WayOut, NeverLeadsThroughTheUnknown) {
  auto plan = kTwoRooms;
  for (auto& row : plan) row[6] = row[6] == '.' ? ' ' : row[6];
  EXPECT_FALSE(find_free_way(map_of(plan), {}, {1.0, 2.6}, {5.5, 2.6}));
}

TEST(WayOut, DoesNotSqueezeThroughAGapThatIsTooNarrow) {
  HudMap map(0.05);
  const auto gap = [](double wide_m) {
    return test::drawn_tiles({0.0, 0.0}, {6.0, 3.0}, [wide_m](const Vector2d& p_m) {
      const bool wall = std::abs(p_m.x() - 3.0) < 0.1 && std::abs(p_m.y() - 1.5) > wide_m / 2.0;
      return wall ? Occupancy::occupied : Occupancy::free;
    });
  };
  map.put(gap(0.3));
  map.refresh();
  EXPECT_FALSE(find_free_way(map, {}, {1.0, 1.5}, {5.0, 1.5}));
  map.put(gap(0.8));
  map.refresh();
  EXPECT_TRUE(find_free_way(map, {}, {1.0, 1.5}, {5.0, 1.5})) << "a door's width";
}

TEST(WayOut, LeadsThroughANarrowPlaceWhereOneHasWalked) {
  HudMap map(0.05);
  map.put(test::drawn_tiles({0.0, 0.0}, {6.0, 3.0}, [](const Vector2d& p_m) {
    const bool wall = std::abs(p_m.x() - 3.0) < 0.1 && std::abs(p_m.y() - 1.5) > 0.15;
    return wall ? Occupancy::occupied : Occupancy::free;
  }));
  map.refresh();
  const Path trail{{1.0, 1.5}, {2.0, 1.5}, {3.0, 1.5}, {4.0, 1.5}, {5.0, 1.5}};
  EXPECT_FALSE(find_free_way(map, {}, {5.0, 1.5}, {1.0, 1.5}));
  const auto path = find_free_way(map, trail, {5.0, 1.5}, {1.0, 1.5});
  ASSERT_TRUE(path);
  EXPECT_FALSE(crosses(map, *path, Occupancy::occupied));
  EXPECT_FALSE(find_way_out(map, trail, {5.0, 1.5})->by_own_trail);
}

TEST(WayOut, ATrailAlongInsideAWallLeadsNotThroughIt) {
  HudMap map(0.05);
  map.put(test::drawn_tiles({0.0, 0.0}, {6.0, 3.0}, [](const Vector2d& p_m) {
    return std::abs(p_m.x() - 3.0) < 0.1 ? Occupancy::occupied : Occupancy::free;
  }));
  map.refresh();
  const Path trail{{1.0, 0.5}, {2.6, 0.5}, {2.95, 0.8}, {3.05, 2.2}, {3.4, 2.5}, {5.0, 2.5}};
  EXPECT_FALSE(find_free_way(map, trail, {1.0, 0.5}, {5.0, 2.5}));
  EXPECT_TRUE(find_way_out(map, trail, {5.0, 2.5})->by_own_trail);
}

TEST(WayOut, FollowsTheOwnTrailWhereNoFreeWayIsKnownAndSaysSo) {
  auto plan = kTwoRooms;
  for (auto& row : plan) row[6] = row[6] == '.' ? ' ' : row[6];
  const Path trail{{1.0, 1.5}, {2.0, 1.5}, {3.2, 1.6}, {4.5, 1.5}};
  const auto way = find_way_out(map_of(plan), trail, {4.6, 1.5});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->by_own_trail);
  EXPECT_EQ(way->points.front(), Vector2d(4.6, 1.5));
  EXPECT_EQ(way->points.back(), Vector2d(1.0, 1.5));
  EXPECT_NEAR(way->length_m, 3.6, 0.1);
  EXPECT_FALSE(find_way_out(map_of(kTwoRooms), trail, {4.6, 1.5})->by_own_trail);
}

TEST(WayOut, TheTrailIsWalkedBackWithoutItsDetours) {
  Path trail;
  for (double x = 0.0; x < 10.0; x += 0.25) trail.push_back({x, 0.0});
  for (double y = 0.25; y < 5.0; y += 0.25) trail.push_back({5.0, y});  // into a room ...
  for (double y = 5.0; y > 0.0; y -= 0.25) trail.push_back({5.2, y});   // ... and out again
  const Path back = walk_back(trail, {5.2, 0.2});
  EXPECT_EQ(back.back(), Vector2d(0.0, 0.0));
  EXPECT_LT(length_of(back), 6.0);
  for (std::size_t i = 1; i < back.size(); ++i) EXPECT_LT((back[i] - back[i - 1]).norm(), 0.5);
}

TEST(WayOut, WithoutATrailThereIsNone) {
  EXPECT_FALSE(find_way_out(map_of(kTwoRooms), {}, {1.0, 1.0}));
}

TEST(WayOut, APointAheadLiesOnThePathOrAtItsEnd) {
  const Path path{{0.0, 0.0}, {2.0, 0.0}, {2.0, 5.0}};
  EXPECT_EQ(point_ahead(path, 3.0), Vector2d(2.0, 1.0));
  EXPECT_EQ(point_ahead(path, 30.0), Vector2d(2.0, 5.0));
  EXPECT_EQ(point_ahead({}, 1.0), Vector2d(0.0, 0.0));
}

TEST(WayOut, ALargeHallIsSearchedInReasonableWork) {
  HudMap map(0.05);
  map.put(test::drawn_tiles({0.0, 0.0}, {60.0, 60.0}, [](const Vector2d& p_m) {
    // A wall with a gap at alternating ends every 6 m: the way is long.
    const bool wall = std::fmod(p_m.y(), 6.0) < 0.2 && p_m.y() > 1.0;
    const bool left = std::fmod(p_m.y(), 12.0) < 6.0;
    const bool gap = left ? p_m.x() < 2.0 : p_m.x() > 58.0;
    return wall && !gap ? Occupancy::occupied : Occupancy::free;
  }));
  map.refresh();
  const auto path = find_free_way(map, {}, {30.0, 3.0}, {30.0, 57.0});
  ASSERT_TRUE(path);
  EXPECT_GT(length_of(*path), 300.0);
  EXPECT_FALSE(crosses(map, *path, Occupancy::occupied));
}

}  // namespace
}  // namespace lifeline::hud
