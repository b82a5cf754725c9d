#include "agents/hud/hud_map.hpp"

#include <random>

#include <gtest/gtest.h>

#include "tests/support/hud_rooms.hpp"

namespace lifeline::hud {
namespace {

/// Random tiles beside each other, some cells unknown.
TEST(HudMap, TellsCellsApartAsTheExportedMapDoes) {
  std::mt19937 random(5);
  TsdGrid grid{GridGeometry{}};
  sharing::MapTiles tiles;
  for (const TileIndex index : {TileIndex{-1, 0}, {0, 0}, {0, 1}, {7, 7}}) {
    auto cells = std::make_shared<QuantisedTile>();
    for (auto& cell : *cells) {
      if (random() % 4 == 0) continue;
      cell = {static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127), 3};
    }
    grid.at(index) = dequantise(*cells);
    tiles.emplace_back(index, cells);
  }
  HudMap map(0.05);
  map.put(tiles);
  EXPECT_TRUE(map.refresh());
  EXPECT_FALSE(map.refresh()) << "nothing changed since";
  const OccupancyGrid expected = to_occupancy(grid).value();
  for (int row = 0; row < expected.rows; ++row) {
    for (int column = 0; column < expected.columns; ++column) {
      const CellIndex cell{column - kTileSide, row};
      ASSERT_EQ(map.at(cell), expected.at(column, row)) << cell.x << " " << cell.y;
    }
  }
}

TEST(HudMap, PeersFillInWhatTheHelmetItselfHasNotSeen) {
  HudMap map(0.05);
  map.put(test::plan_tiles({"..", ".."}));  // the lower left square metre
  auto peers = std::make_shared<TsdTile>();
  peers->fill({0, 640});  // they say: wall everywhere
  map.put(sharing::PeerUpdate{{{TileIndex{0, 0}, peers}}, 0.5});
  map.refresh();
  EXPECT_EQ(map.at({5, 5}), Occupancy::free) << "seen with own eyes";
  EXPECT_EQ(map.at({40, 40}), Occupancy::occupied);
  map.put(sharing::PeerUpdate{{{TileIndex{0, 0}, nullptr}}, 0.5});
  map.refresh();
  EXPECT_EQ(map.at({40, 40}), Occupancy::unknown) << "what is withdrawn leaves no trace";
}

TEST(HudMap, AWallAtATilesEdgeIsSeenFromTheNextTile) {
  HudMap map(0.05);
  const double edge_m = 64 * 0.05;
  map.put(test::drawn_tiles({0.0, 0.0}, {6.0, 3.0}, [&](const Eigen::Vector2d& p_m) {
    return p_m.x() > edge_m && p_m.x() < edge_m + 0.05 ? Occupancy::occupied : Occupancy::free;
  }));
  map.refresh();
  EXPECT_EQ(map.at({64, 10}), Occupancy::occupied);
  EXPECT_EQ(map.at({63, 10}), Occupancy::free);
  EXPECT_EQ((*map.shades({0, 0}))[offset_in_tile({63, 10})], Occupancy::occupied)
      << "drawn a cell thicker";
  EXPECT_FALSE(map.is_passable({15, 2})) << "a shoulder would meet it";
  EXPECT_TRUE(map.is_passable({14, 2}));
}

TEST(HudMap, TilesOutOfRangeAreLeftOut) {
  HudMap map(0.05);
  auto cells = std::make_shared<const QuantisedTile>();
  map.put(sharing::MapTiles{{TileIndex{100'000, 0}, cells}, {TileIndex{0, -513}, cells}});
  map.refresh();
  EXPECT_EQ(map.tile_count(), 0U);
}

}  // namespace
}  // namespace lifeline::hud
