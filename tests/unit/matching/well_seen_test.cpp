// Which free space of a TSD layer may contradict another map.

#include <cmath>

#include <gtest/gtest.h>

#include "coordinator/matching/candidate.hpp"
#include "coordinator/matching/compare_walls.hpp"
#include "tests/support/drawn_building.hpp"

namespace lifeline::matching {
namespace {

/// A layer that saw a square of 8 m free, every cell with this weight (W of Eq. 3).
MapFeatures free_square(double weight) {
  TsdGrid tsd;
  const TsdCell seen{TsdCell::kTsdOne,
                     static_cast<std::uint16_t>(std::lround(weight * TsdCell::kWeightOne))};
  for (int y = -80; y < 80; ++y) {
    for (int x = -80; x < 80; ++x) {
      tsd.at(tile_of(CellIndex{x, y}))[offset_in_tile(CellIndex{x, y})] = seen;
    }
  }
  return build_features(tsd).value();
}

/// A wall of 4 m across the middle of that square.
MapFeatures wall_across() {
  test::DrawnBuilding building;
  building.rooms.push_back({{-2.0, 0.0}, {2.0, 3.0}});
  building.walls = {{{-2.0, 0.0}, {2.0, 0.0}}};
  return build_features(test::draw_map(building, {}, 10.0)).value();
}

double conflicting_m(const MapFeatures& a, const MapFeatures& b) {
  const Pose2 T_a_b = to_local_frames(a, b, {});
  return compare_walls(b.walls, T_a_b, a, kFineGate).conflicting_m;
}

TEST(WellSeenTest, FreeSpaceThatManyScansSawContradictsAWall) {
  EXPECT_NEAR(conflicting_m(free_square(8.0), wall_across()), 4.0, 0.5);
}

TEST(WellSeenTest, FreeSpaceThatFewScansSawContradictsNothing) {
  EXPECT_EQ(conflicting_m(free_square(2.0), wall_across()), 0.0);
}

TEST(WellSeenTest, FreeSpaceThatFewScansSawStaysExplored) {
  EXPECT_NEAR(free_square(2.0).known_m2, 64.0, 1.0);
}

}  // namespace
}  // namespace lifeline::matching
