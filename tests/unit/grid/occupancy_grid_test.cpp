#include "common/grid/occupancy_grid.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline {
namespace {

using Rows = std::vector<std::string>;

/// A TSD grid drawn as text, the upper row first, its lower left cell at `corner`:
/// '+' free, 'f' free near a surface, '0' on it, '-' behind it, ' ' unknown.
TsdGrid tsd(const Rows& rows, CellIndex corner) {
  TsdGrid grid({.cell_size_m = 0.05, .truncation_m = 0.15});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const CellIndex cell{corner.x + static_cast<int>(c),
                           corner.y + static_cast<int>(rows.size() - 1 - r)};
      TsdCell& value = grid.at(tile_of(cell))[offset_in_tile(cell)];
      value.weight = rows[r][c] == ' ' ? 0 : 64;
      switch (rows[r][c]) {
        case '+':
          value.tsd = TsdCell::kTsdOne;
          break;
        case 'f':
          value.tsd = 1;
          break;
        case '-':
          value.tsd = -20000;
          break;
        default:
          value.tsd = 0;
      }
    }
  }
  return grid;
}

/// The part of an occupancy grid that `rows` of this size cover: '#' occupied, '.' free, ' '
/// unknown.
Rows picture(const OccupancyGrid& grid, CellIndex corner, std::size_t columns, std::size_t rows) {
  const int first_column =
      corner.x - static_cast<int>(std::lround(grid.origin_m.x() / grid.cell_size_m));
  const int first_row =
      corner.y - static_cast<int>(std::lround(grid.origin_m.y() / grid.cell_size_m));
  Rows drawn;
  for (int r = static_cast<int>(rows) - 1; r >= 0; --r) {
    drawn.emplace_back();
    for (int c = 0; c < static_cast<int>(columns); ++c) {
      drawn.back() += " .#"[static_cast<int>(grid.at(first_column + c, first_row + r))];
    }
  }
  return drawn;
}

void expect_occupancy(const Rows& from, const Rows& expected) {
  // Within a tile, across four tiles, and far in the negative.
  for (const CellIndex corner : {CellIndex{10, 10}, CellIndex{-3, -2}, CellIndex{-1025, 700}}) {
    const OccupancyGrid grid = to_occupancy(tsd(from, corner)).value();
    EXPECT_EQ(picture(grid, corner, from[0].size(), from.size()), expected)
        << "at cell " << corner.x << ", " << corner.y;
  }
}

TEST(Occupancy, BothSidesOfASignChangeAreOccupied) {
  expect_occupancy({"++++++",  //
                    "ffffff",  //
                    "------",  //
                    "------",  //
                    "      "},
                   {"......",  //
                    "######",  //
                    "######",  //
                    "      ",  //
                    "      "});
}

TEST(Occupancy, AWallInXIsFoundToo) {
  expect_occupancy({"++f--f++",  //
                    "++f--f++"},
                   {"..####..",  //
                    "..####.."});
}

TEST(Occupancy, AThinWallStandsBetweenItsTwoSides) {
  expect_occupancy({"++++++",  //
                    "++f-f+",  //
                    "++++++"},
                   {"...#..",  //
                    "..###.",  //
                    "...#.."});
}

TEST(Occupancy, AlongADiagonalNoCornerCounts) {
  expect_occupancy({"+++",  //
                    "+++",  //
                    "-++"},
                   {"...",  //
                    "#..",  //
                    "##."});
}

TEST(Occupancy, ACellOnTheSurfaceIsOccupied) {
  expect_occupancy({"+0+", "+++"}, {".#.", "..."});
}

TEST(Occupancy, TheUnknownIsNoSurface) {
  expect_occupancy({"+ -", "+++"}, {". #", "..#"});
  expect_occupancy({" - "}, {"   "});
}

TEST(Occupancy, TheGridCoversWholeTilesInTheMapsFrame) {
  const OccupancyGrid grid = to_occupancy(tsd({"+"}, {-1, 64})).value();
  EXPECT_EQ(grid.columns, 64);
  EXPECT_EQ(grid.rows, 64);
  EXPECT_NEAR(grid.origin_m.x(), -3.2, 1e-12);
  EXPECT_NEAR(grid.origin_m.y(), 3.2, 1e-12);
  EXPECT_EQ(grid.at(63, 0), Occupancy::free);
  EXPECT_EQ(grid.at(64, 0), Occupancy::unknown);
  EXPECT_EQ(grid.at(0, -1), Occupancy::unknown);
  EXPECT_EQ(known_cells(grid), 1U);
}

TEST(Occupancy, AnEmptyMapIsAnEmptyGrid) {
  const OccupancyGrid grid = to_occupancy(TsdGrid()).value();
  EXPECT_EQ(grid.columns, 0);
  EXPECT_EQ(known_cells(grid), 0U);
}

TEST(Occupancy, TilesTooFarApartMakeNoGridButAreCounted) {
  TsdGrid apart = tsd({"+f-"}, {0, 0});
  const TsdCell free{TsdCell::kTsdOne, TsdCell::kWeightOne};
  apart.at({kMaxTileIndex - 1, 0})[0] = free;
  EXPECT_EQ(to_occupancy(apart).error().code, ErrorCode::unsupported);
  EXPECT_THAT(to_occupancy(apart).error().text, testing::HasSubstr("32768 x 64 cells"));
  EXPECT_EQ(known_cells(apart), 4U);

  TsdGrid square = tsd({"+f-"}, {0, 0});  // each side would do, both do not
  square.at({200, 200})[0] = free;
  EXPECT_EQ(to_occupancy(square).error().code, ErrorCode::unsupported);
}

TEST(Occupancy, AMapCountsWhatItsGridCounts) {
  const TsdGrid map = tsd({"++f-f+", " 0 -+ ", "------"}, {-3, 62});
  EXPECT_EQ(known_cells(map), known_cells(to_occupancy(map).value()));
  EXPECT_GT(known_cells(map), 0U);
}

}  // namespace
}  // namespace lifeline
