#include "common/grid/tsd_update.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/grid/occupancy_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline {
namespace {

using support::FlatWorld;
using support::hit_beam;
using support::scan_of;

constexpr int kCap = 32 * TsdCell::kWeightOne;
constexpr std::int16_t kOne = TsdCell::kTsdOne;

TsdCell cell(double tsd, double weight) {
  return {static_cast<std::int16_t>(std::lround(tsd * kOne)),
          static_cast<std::uint16_t>(std::lround(weight * TsdCell::kWeightOne))};
}

TEST(UpdatedCell, IsTheWeightedMeanOfEquation2) {
  const TsdCell mean = updated(cell(0.5, 3.0), cell(0.1, 1.0), kCap);
  EXPECT_NEAR(mean.value(), 0.4F, 1e-4F);
  EXPECT_NEAR(mean.weight_value(), 4.0F, 1e-6F);  // Eq. 3
}

TEST(UpdatedCell, TakesTheFirstObservationAsItIs) {
  EXPECT_EQ(updated({}, cell(-0.3, 0.5), kCap), cell(-0.3, 0.5));
  EXPECT_EQ(updated(cell(0.7, 2.0), {}, kCap), cell(0.7, 2.0));
}

TEST(UpdatedCell, WeightStopsAtTheCapAndTheMeanKeepsMoving) {
  TsdCell at_cap = cell(0.0, 32.0);
  for (int i = 0; i < 500; ++i) at_cap = updated(at_cap, cell(0.5, 1.0), kCap);
  EXPECT_EQ(at_cap.weight, kCap);
  EXPECT_NEAR(at_cap.value(), 0.5F, 1e-2F);
}

/// How many observations `seen` it takes until `from` changes its sign.
int scans_until_learnt(TsdCell from, TsdCell seen) {
  int scans = 0;
  for (TsdCell now = from; (now.tsd > 0) == (from.tsd > 0) && scans < 1000; ++scans) {
    now = updated(now, seen, kCap);
  }
  return scans;
}

/// The same by the plain mean of Eq. 2 and 3, its weight capped.
int scans_by_the_plain_mean(double from, double seen, double seen_weight) {
  int scans = 0;
  double weight = 32.0;
  for (double now = from; (now > 0.0) == (from > 0.0) && scans < 1000; ++scans) {
    now = (now * weight + seen * seen_weight) / (weight + seen_weight);
    weight = std::min(32.0, weight + seen_weight);
  }
  return scans;
}

TEST(UpdatedCell, AChangedWorldIsLearntInTwoThirdsOfThePlainMeansScans) {
  // A door that stood here for long has opened ...
  EXPECT_LE(3 * scans_until_learnt(cell(-0.3, 32.0), cell(1.0, 0.5)),
            2 * scans_by_the_plain_mean(-0.3, 1.0, 0.5));
  // ... or closed where all was free.
  EXPECT_LE(3 * scans_until_learnt(cell(1.0, 32.0), cell(-0.2, 0.8)),
            2 * scans_by_the_plain_mean(1.0, -0.2, 0.8));
}

TEST(UpdatedCell, WhatLiesDeepBehindASurfaceDoesNotOverruleItsOtherSide) {
  const TsdCell seen_from_its_side = cell(0.3, 4.0);
  EXPECT_EQ(updated(seen_from_its_side, cell(-0.8, 0.05), kCap), seen_from_its_side);
  EXPECT_NE(updated(seen_from_its_side, cell(-0.2, 0.7), kCap), seen_from_its_side);
}

/// How many dense looks `seen` it takes until `from` changes its sign.
int dense_looks_until_learnt(TsdCell from, TsdCell seen) {
  int looks = 0;
  for (TsdCell now = from; (now.tsd > 0) == (from.tsd > 0) && looks < 1000; ++looks) {
    now = updated_densely(now, seen, kCap);
  }
  return looks;
}

TEST(UpdatedCellDensely, AChangedWorldIsLearntWithin20LooksHoweverSureTheCellWas) {
  for (double weight = 0.5; weight <= 32.0; weight += 0.5) {
    // A door has opened ...
    for (double was = -0.9; was < 0.0; was += 0.1) {
      EXPECT_LE(dense_looks_until_learnt(cell(was, weight), cell(1.0, 0.5)), 20) << weight;
    }
    // ... or closed.
    for (double is = -0.38; is < 0.0; is += 0.06) {
      const double seen_weight = 0.8 * (1.0 + is) * (1.0 + is);
      EXPECT_LE(dense_looks_until_learnt(cell(1.0, weight), cell(is, seen_weight)), 20) << weight;
    }
  }
}

TEST(UpdatedCellDensely, WhatIsSeenEverySecondTimeStaysWhereItIs) {
  TsdCell glass = cell(-0.2, 8.0);
  for (int i = 0; i < 1000; ++i) {
    glass = updated_densely(glass, i % 2 == 0 ? cell(1.0, 0.5) : cell(-0.2, 0.9), kCap);
    EXPECT_EQ(glass.tsd, cell(-0.2, 1.0).tsd) << i;
  }
}

TEST(UpdatedCellDensely, AFewWrongLooksDoNotShiftAWall) {
  TsdCell wall = cell(-0.2, 32.0);
  for (int i = 0; i < 5; ++i) wall = updated_densely(wall, cell(1.0, 0.5), kCap);
  EXPECT_EQ(wall.tsd, cell(-0.2, 1.0).tsd);
  EXPECT_LT(wall.weight_value(), 10.0F);
}

TEST(UpdatedCellDensely, IsEquations2And3WhereNothingContradicts) {
  for (double was = -1.0; was <= 1.0; was += 0.1) {
    for (double is = was - 0.49; is <= was + 0.49; is += 0.07) {
      if (std::abs(is) > 1.0) continue;
      EXPECT_EQ(updated_densely(cell(was, 3.0), cell(is, 0.6), kCap),
                updated(cell(was, 3.0), cell(is, 0.6), kCap));
    }
  }
}

TEST(UpdatedCellDensely, WhatLiesDeepBehindASurfaceDoesNotOverruleItsOtherSide) {
  const TsdCell seen_from_its_side = cell(0.3, 4.0);
  EXPECT_EQ(updated_densely(seen_from_its_side, cell(-0.8, 0.05), kCap), seen_from_its_side);
}

/// A grid and its updater at the usual geometry.
struct Map {
  GridGeometry geometry{0.05, 0.15};
  TsdGrid grid{geometry};
  TsdUpdater updater{geometry, {}};

  std::vector<TileIndex> push(const Scan2& scan, const Pose2& T_map_head, double weight = 1.0,
                              Looks looks = Looks::sparse) {
    const auto changed = updater.push(extract_surface(scan), T_map_head, weight, grid, looks);
    return {changed.begin(), changed.end()};
  }
  [[nodiscard]] TsdCell at(double x, double y) const { return grid.cell(grid.cell_at({x, y})); }
};

const FlatWorld kWallAhead = FlatWorld().add(2.01, -5.0, 2.01, 5.0);
const support::Lidar kForward{.beams = 121, .first_angle_rad = -M_PI / 3, .step_rad = M_PI / 180};

TEST(PushScan, DistancesArePerpendicularToTheSurfaceNotAlongTheBeam) {
  Map map;
  map.push(scan_of(kWallAhead, {}, kForward), {});
  for (double y = -3.0; y < 3.0; y += 0.21) {
    for (double x = 1.89; x < 2.1; x += 0.05) {
      const CellIndex index = map.grid.cell_at({x, y});
      const double truth_m = 2.01 - map.grid.centre_of(index).x();
      const TsdCell found = map.grid.cell(index);
      ASSERT_TRUE(found.known()) << x << " " << y;
      EXPECT_NEAR(found.value(), truth_m / 0.15, 0.02) << x << " " << y;
    }
  }
}

TEST(PushScan, LeavesNoHolesBetweenBeamsFarApart) {
  Map map;
  const FlatWorld far = FlatWorld().add(9.0, -9.0, 9.0, 9.0);
  map.push(scan_of(far, {}, {.beams = 31, .first_angle_rad = -0.26, .step_rad = M_PI / 180}), {});
  for (double y = -2.0; y < 2.0; y += 0.05) {
    EXPECT_TRUE(map.at(8.93, y).known()) << y;
    EXPECT_EQ(map.at(6.0, y * 0.6).tsd, kOne) << y;
  }
}

TEST(PushScan, CarvesFreeSpaceBeforeTheSurfaceAndNothingBeyond) {
  Map map;
  map.push(scan_of(kWallAhead, {}, kForward), {});
  EXPECT_EQ(map.at(1.0, 0.0).tsd, kOne);
  EXPECT_LT(map.at(2.04, 0.0).tsd, 0);
  EXPECT_FALSE(map.at(2.3, 0.0).known());
  EXPECT_FALSE(map.at(4.0, 0.0).known());
  EXPECT_FALSE(map.at(-0.5, 0.0).known());  // behind the lidar
}

TEST(PushScan, BeamsWithoutReturnAndBadReadingsCarveNothing) {
  for (const BeamKind kind : {BeamKind::no_return, BeamKind::invalid}) {
    Map map;
    Scan2 scan = scan_of(kWallAhead, {}, kForward);
    for (std::size_t i = 40; i < 80; ++i) scan.beams[i].kind = kind;
    map.push(scan, {});
    EXPECT_FALSE(map.at(1.0, 0.0).known());
    EXPECT_FALSE(map.at(2.0, 0.0).known());
    EXPECT_TRUE(map.at(1.0, 1.0).known());
    EXPECT_TRUE(map.at(1.0, -1.0).known());
  }
}

TEST(PushScan, AScanThatShowsNothingChangesNothing) {
  Map map;
  EXPECT_TRUE(map.push({}, {}).empty());
  Scan2 one;  // how its surface lies nobody knows: nothing is carved up to it
  one.beams.push_back(hit_beam(0.0, 3.0));
  (void)map.push(one, {});
  for (double x = 0.0; x < 2.8; x += 0.05) EXPECT_FALSE(map.at(x, 0.0).known()) << x;
  for (double x = 3.2; x < 6.0; x += 0.05) EXPECT_FALSE(map.at(x, 0.0).known()) << x;
}

TEST(PushScan, AWallSeenAtAFlatAngleIsNotCarvedThrough) {
  // A corridor seen from its end by beams 1 deg apart: far down they hit the walls metres apart.
  Map map;
  const FlatWorld corridor = FlatWorld().add(-1.0, 1.0, 25.0, 1.0).add(-1.0, -1.0, 25.0, -1.0);
  const support::Lidar half{.beams = 180, .first_angle_rad = -M_PI / 2, .step_rad = M_PI / 180};
  for (double x = 0.0; x < 3.0; x += 0.1) map.push(scan_of(corridor, {x, 0.0, 0.0}, half), {x});
  for (const TileIndex tile : map.grid.tiles()) {
    const CellIndex first = first_cell(tile);
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const CellIndex index{first.x + x, first.y + y};
        if (std::abs(map.grid.centre_of(index).y()) > 1.04) {
          EXPECT_LE(map.grid.cell(index).tsd, 0) << map.grid.centre_of(index).transpose();
        }
      }
    }
  }
}

void expect_thin_walls_keep_both_sides(Looks looks) {
  Map map;
  const FlatWorld world = FlatWorld().add(2.0, -5.0, 2.0, 5.0).add(2.1, -5.0, 2.1, 5.0);
  const support::Lidar back{
      .beams = 121, .first_angle_rad = M_PI - M_PI / 3, .step_rad = M_PI / 180};
  // Long looks from one side, few from the other: what the first extrapolated fades.
  for (int i = 0; i < 200; ++i) map.push(scan_of(world, {}, kForward), {}, 1.0, looks);
  for (int i = 0; i < 20; ++i) {
    map.push(scan_of(world, {4.0, 0.0, 0.0}, back), {4.0, 0.0, 0.0}, 1.0, looks);
  }
  for (double y = -1.5; y < 1.5; y += 0.13) {
    EXPECT_GT(map.at(1.97, y).tsd, 0) << y;
    EXPECT_GT(map.at(2.13, y).tsd, 0) << y;
    EXPECT_LT(map.at(2.03, y).tsd, 0) << y;
    EXPECT_LT(map.at(2.07, y).tsd, 0) << y;
  }
  const OccupancyGrid occupancy = to_occupancy(map.grid).value();
  EXPECT_GT(known_cells(occupancy), 1000U);
}

TEST(PushScan, AThinWallSeenFromBothSidesKeepsBoth) {
  expect_thin_walls_keep_both_sides(Looks::sparse);
}

TEST(PushScan, AThinWallSeenFromBothSidesKeepsBothAmongDenseLooks) {
  expect_thin_walls_keep_both_sides(Looks::dense);
}

TEST(PushScan, WhatMovedAwayIsForgotten) {
  Map map;
  FlatWorld with_person = kWallAhead;
  with_person.add_box(1.0, -0.2, 1.3, 0.2);
  for (int i = 0; i < 4; ++i) map.push(scan_of(with_person, {}, kForward), {});
  EXPECT_LT(map.at(1.02, 0.0).tsd, 0);
  for (int i = 0; i < 20; ++i) map.push(scan_of(kWallAhead, {}, kForward), {});
  EXPECT_GT(map.at(1.02, 0.0).value(), 0.7F);
}

TEST(PushScan, NamesTheTilesThatChangedAndNoOthers) {
  Map map;
  const auto first = map.push(scan_of(kWallAhead, {}, kForward), {});
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
  EXPECT_EQ(first, map.grid.tiles());
  // Once all weights are at the cap and the scan says nothing new, nothing changes.
  for (int i = 0; i < 5000; ++i) map.push(scan_of(kWallAhead, {}, kForward), {});
  EXPECT_TRUE(map.push(scan_of(kWallAhead, {}, kForward), {}).empty());
}

TEST(PushScan, ATrustedScanWeighsMore) {
  Map full, half;
  full.push(scan_of(kWallAhead, {}, kForward), {});
  half.push(scan_of(kWallAhead, {}, kForward), {}, 0.5);
  EXPECT_NEAR(half.at(1.97, 0.0).weight_value(), 0.5F * full.at(1.97, 0.0).weight_value(), 0.02F);
  EXPECT_EQ(half.at(1.97, 0.0).tsd, full.at(1.97, 0.0).tsd);
}

TEST(PushScan, FarFromTheOriginItIsAsExact) {
  Map near, far;
  near.push(scan_of(kWallAhead, {}, kForward), {0.0, 0.0, 0.3});
  const Pose2 away{1.0 * 1024 * 0.05, -1.0 * 2048 * 0.05, 0.3};  // whole cells
  far.push(scan_of(kWallAhead, {}, kForward), away);
  int compared = 0;
  for (const TileIndex tile : near.grid.tiles()) {
    const TsdTile* other = far.grid.find({tile.x + 16, tile.y - 32});
    ASSERT_NE(other, nullptr);
    for (std::size_t i = 0; i < kTileCells; ++i) {
      const TsdCell a = (*near.grid.find(tile))[i], b = (*other)[i];
      EXPECT_EQ(a.known(), b.known());
      EXPECT_NEAR(a.tsd, b.tsd, 20);
      compared += a.known() ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(PushScan, BeyondTheLargestTileNothingIsWritten) {
  Map map;
  const double edge_m = kMaxTileIndex * kTileSide * 0.05;
  map.push(scan_of(kWallAhead, {}, kForward), {edge_m - 1.0, 0.0, 0.0});
  for (const TileIndex tile : map.grid.tiles()) EXPECT_TRUE(is_in_range(tile));
  EXPECT_GT(map.grid.tile_count(), 0U);
}

}  // namespace
}  // namespace lifeline
