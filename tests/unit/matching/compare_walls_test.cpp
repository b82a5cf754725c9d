#include "coordinator/matching/compare_walls.hpp"

#include <gtest/gtest.h>

#include "coordinator/matching/candidate.hpp"
#include "tests/support/drawn_building.hpp"

namespace lifeline::matching {
namespace {

using test::draw_map;
using test::DrawnBuilding;

/// A corridor of 12 m whose upper wall lies at `y`, with a hall below it that both maps share.
MapFeatures corridor_with_wall_at(double y) {
  DrawnBuilding building;
  building.rooms.push_back({{-6.0, -6.0}, {6.0, y}});
  building.walls = {{{-6.0, -6.0}, {6.0, -6.0}},
                    {{-6.0, -6.0}, {-6.0, y}},
                    {{6.0, -6.0}, {6.0, y}},
                    {{-6.0, y}, {6.0, y}}};
  return build_features(draw_map(building, {}, 18.0)).value();
}

/// Of wall that contradicts when b lies on a as drawn, per map: all of it, and what is displaced.
struct Contradiction {
  double conflicting_m, displaced_m;
};

Contradiction compare(const MapFeatures& a, const MapFeatures& b) {
  const Pose2 T_a_b = to_local_frames(a, b, {});
  return {compare_walls(b.walls, T_a_b, a, kFineGate).conflicting_m,
          displaced_conflict_m(b.walls, T_a_b, a)};
}

TEST(CompareWallsTest, AWallThatABendMovedContradictsAndIsDisplaced) {
  const auto [conflicting_m, displaced_m] =
      compare(corridor_with_wall_at(2.0), corridor_with_wall_at(1.3));
  EXPECT_NEAR(conflicting_m, 12.0, 1.0);
  EXPECT_NEAR(displaced_m, conflicting_m, 0.5);
}

TEST(CompareWallsTest, AWallThatTheOtherMapDoesNotHaveIsNotDisplaced) {
  const auto [conflicting_m, displaced_m] =
      compare(corridor_with_wall_at(4.0), corridor_with_wall_at(1.3));
  EXPECT_NEAR(conflicting_m, 12.0, 1.0);
  EXPECT_LT(displaced_m, 0.5);
}

TEST(CompareWallsTest, AWallThatFacesTheOtherWayIsNotDisplaced) {
  DrawnBuilding beyond;  // its lower wall faces up, half a metre below the other's upper wall
  beyond.rooms.push_back({{-6.0, 1.5}, {6.0, 7.0}});
  beyond.walls = {{{-6.0, 1.5}, {6.0, 1.5}}};
  const auto [conflicting_m, displaced_m] =
      compare(corridor_with_wall_at(2.0), build_features(draw_map(beyond, {}, 18.0)).value());
  EXPECT_GT(conflicting_m, 8.0);
  EXPECT_LT(displaced_m, 0.5);
}

TEST(CompareWallsTest, WallThatAgreesIsNeitherInConflictNorDisplaced) {
  const MapFeatures map = corridor_with_wall_at(2.0);
  const auto [conflicting_m, displaced_m] = compare(map, map);
  EXPECT_EQ(conflicting_m, 0.0);
  EXPECT_EQ(displaced_m, 0.0);
}

}  // namespace
}  // namespace lifeline::matching
