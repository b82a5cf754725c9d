#include "common/grid/tsd_grid.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "tests/support/tiles.hpp"

namespace lifeline {
namespace {

using ::testing::ElementsAre;

TEST(TileIndex, NegativeCellsBelongToNegativeTiles) {
  EXPECT_EQ(tile_of({0, 0}), (TileIndex{0, 0}));
  EXPECT_EQ(tile_of({63, 64}), (TileIndex{0, 1}));
  EXPECT_EQ(tile_of({-1, -64}), (TileIndex{-1, -1}));
  EXPECT_EQ(tile_of({-65, -128}), (TileIndex{-2, -2}));
  EXPECT_EQ(offset_in_tile({-1, -64}), 63U);
  EXPECT_EQ(offset_in_tile({64, 1}), 64U);
}

TEST(TileIndex, FirstCellLiesInItsTile) {
  for (const TileIndex tile : {TileIndex{0, 0}, TileIndex{-3, 7}, TileIndex{511, -512}}) {
    EXPECT_EQ(tile_of(first_cell(tile)), tile);
    EXPECT_EQ(offset_in_tile(first_cell(tile)), 0U);
  }
}

TEST(TileIndex, TilesFarOffDoNotExist) {
  EXPECT_TRUE(is_in_range({511, -512}));
  EXPECT_FALSE(is_in_range({512, 0}));
  EXPECT_FALSE(is_in_range({0, -513}));
  EXPECT_FALSE(is_in_range({std::numeric_limits<std::int32_t>::min(), 0}));
}

TEST(TsdGrid, AnEmptyOneKnowsNothing) {
  const TsdGrid grid;
  EXPECT_EQ(grid.find({0, 0}), nullptr);
  EXPECT_FALSE(grid.cell({-5, 12}).known());
  EXPECT_TRUE(grid.tiles().empty());
  EXPECT_EQ(known_area_m2(grid), 0.0);
}

TEST(TsdGrid, KeepsEveryTileWhileItGrowsInAllDirections) {
  TsdGrid grid;
  std::uint16_t mark = 0;
  const TileIndex walk[] = {{0, 0},     {9, 0},     {9, 11},     {-20, 3},
                            {-20, -30}, {511, 511}, {-512, -512}};
  for (const TileIndex tile : walk) grid.at(tile)[17] = {100, ++mark};
  EXPECT_EQ(grid.tile_count(), 7U);
  mark = 0;
  for (const TileIndex tile : walk) {
    ASSERT_NE(grid.find(tile), nullptr);
    EXPECT_EQ((*grid.find(tile))[17], (TsdCell{100, ++mark}));
  }
  EXPECT_EQ(grid.find({1, 0}), nullptr);
}

TEST(TsdGrid, ATileStaysWhereItIsWhileOthersAreAdded) {
  TsdGrid grid;
  const TsdTile* const first = &grid.at({0, 0});
  for (int i = -50; i < 50; ++i) (void)grid.at({i, -i});
  EXPECT_EQ(grid.find({0, 0}), first);
}

TEST(TsdGrid, ListsItsTilesByXThenY) {
  TsdGrid grid;
  for (const TileIndex tile : {TileIndex{2, -1}, TileIndex{-3, 5}, TileIndex{2, -7}})
    (void)grid.at(tile);
  EXPECT_THAT(grid.tiles(), ElementsAre(TileIndex{-3, 5}, TileIndex{2, -7}, TileIndex{2, -1}));
}

TEST(TsdGrid, ForgetsATileOrAll) {
  TsdGrid grid;
  (void)grid.at({0, 0});
  (void)grid.at({-4, 2});
  grid.erase({0, 0});
  grid.erase({99, 99});
  EXPECT_THAT(grid.tiles(), ElementsAre(TileIndex{-4, 2}));
  grid.clear();
  EXPECT_EQ(grid.tile_count(), 0U);
  EXPECT_FALSE(grid.at({-4, 2})[0].known());
}

TEST(TsdGrid, ACellSpansFromItsIndexToTheNext) {
  const TsdGrid grid({.cell_size_m = 0.05, .truncation_m = 0.15});
  EXPECT_EQ(grid.cell_at({0.0, 0.049}), (CellIndex{0, 0}));
  EXPECT_EQ(grid.cell_at({-0.001, 0.051}), (CellIndex{-1, 1}));
  EXPECT_EQ(grid.cell_at(grid.centre_of({-37, 1200})), (CellIndex{-37, 1200}));
  EXPECT_NEAR(grid.centre_of({-1, 0}).x(), -0.025, 1e-12);
}

TEST(TsdGrid, CountsKnownCellsAsArea) {
  TsdGrid grid({.cell_size_m = 0.1, .truncation_m = 0.3});
  for (std::size_t i = 0; i < 50; ++i) grid.at({3, -3})[i].weight = 1;
  EXPECT_NEAR(known_area_m2(grid), 0.5, 1e-12);
}

TEST(TsdGridDeath, ATileOutOfRangeIsABug) {
  TsdGrid grid;
  EXPECT_DEATH((void)grid.at({512, 0}), "is_in_range");
}

TEST(Quantise, RoundsToTheNearestStep) {
  EXPECT_EQ(quantise(TsdCell{TsdCell::kTsdOne, 64}).tsd, QuantisedCell::kTsdOne);
  EXPECT_EQ(quantise(TsdCell{-TsdCell::kTsdOne, 64}).tsd, -QuantisedCell::kTsdOne);
  const int step = TsdCell::kTsdOne / QuantisedCell::kTsdOne;
  EXPECT_EQ(quantise(TsdCell{static_cast<std::int16_t>(step * 2 / 5), 64}).tsd, 0);
  EXPECT_EQ(quantise(TsdCell{static_cast<std::int16_t>(step * 3 / 5), 64}).tsd, 1);
  EXPECT_EQ(quantise(TsdCell{static_cast<std::int16_t>(-step * 3 / 5), 64}).tsd, -1);
}

TEST(Quantise, AKnownCellStaysKnownAndAnUnknownOneUnknown) {
  EXPECT_EQ(quantise(TsdCell{5, 1}).weight, 1);
  EXPECT_EQ(quantise(TsdCell{5, 65535}).weight, QuantisedCell::kMaxWeight);
  EXPECT_EQ(quantise(TsdCell{123, 0}), QuantisedCell{});
  EXPECT_EQ(dequantise(QuantisedCell{7, 0}), TsdCell{});
}

TEST(Quantise, ATileIsQuantisedCellByCell) {
  const QuantisedTile tile = support::wall_tile(0.8);
  const TsdTile cells = dequantise(tile);
  EXPECT_EQ(cells[77], dequantise(tile[77]));
  EXPECT_EQ(quantise(cells), tile);
}

}  // namespace
}  // namespace lifeline
