#include "coordinator/dashboard/tile_book.hpp"

#include <array>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <zstd.h>

#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {
namespace {

namespace pb = proto::dashboard;

std::shared_ptr<const sharing::FusedTile> cells(std::uint8_t weight) {
  auto tile = std::make_shared<sharing::FusedTile>();
  std::mt19937 random(weight);
  for (auto& cell : *tile) {
    if (random() % 2 == 0) continue;
    cell = {static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127), weight};
  }
  return tile;
}

pb::Tiles parse(const std::shared_ptr<const std::string>& frame) {
  pb::ServerFrame message;
  EXPECT_TRUE(message.ParseFromString(*frame));
  return message.tiles();
}

TEST(TileBookTest, APackedTileIsItsCellsAgain) {
  const auto tile = cells(200);
  const std::string packed = pack_tile(*tile);
  std::array<std::uint8_t, 2 * kTileCells> planes;
  ASSERT_EQ(ZSTD_decompress(planes.data(), planes.size(), packed.data(), packed.size()),
            planes.size());
  for (std::size_t i = 0; i < kTileCells; ++i) {
    ASSERT_EQ(static_cast<std::int8_t>(planes[i]), (*tile)[i].tsd);
    ASSERT_EQ(planes[kTileCells + i], (*tile)[i].weight);
  }
}

TEST(TileBookTest, ASlowReaderGetsEachTileOnceAsItStandsNow) {
  TileBook book;
  for (std::uint8_t round = 1; round <= 20; ++round) {
    for (std::int32_t x = 0; x < 10; ++x) book.put({"", {x, 0}, cells(round)});
  }
  TileBook::Version seen = 0;
  std::multiset<std::int32_t> got;
  bool is_complete = false;
  while (const auto frame = book.next_frame("", seen, 10'000)) {
    const auto tiles = parse(frame);
    EXPECT_EQ(tiles.from_start(), got.empty());
    for (const auto& tile : tiles.tiles()) {
      got.insert(tile.x());
      EXPECT_EQ(tile.cells(), pack_tile(*cells(20)));
    }
    EXPECT_LT(frame->size(), 30'000U);
    is_complete = tiles.is_complete();
  }
  EXPECT_TRUE(is_complete);
  EXPECT_EQ(got.size(), 10U);
  EXPECT_EQ(std::set(got.begin(), got.end()).size(), 10U);
}

TEST(TileBookTest, ATileThatIsGoneIsSaidToWhoHadIt) {
  TileBook book;
  book.put({"", {1, 2}, cells(1)});
  TileBook::Version seen = 0;
  (void)book.next_frame("", seen, 10'000);
  book.put({"", {1, 2}, nullptr});
  const auto tiles = parse(book.next_frame("", seen, 10'000));
  ASSERT_EQ(tiles.tiles_size(), 1);
  EXPECT_TRUE(tiles.tiles(0).cells().empty());
  TileBook::Version fresh = 0;
  EXPECT_EQ(parse(book.next_frame("", fresh, 10'000)).tiles_size(), 0);
}

TEST(TileBookTest, AMapThatIsNotThereIsEmptyAndSaidOnce) {
  TileBook book;
  TileBook::Version seen = 0;
  const auto tiles = parse(book.next_frame("nobody/1", seen, 10'000));
  EXPECT_TRUE(tiles.from_start() && tiles.is_complete());
  EXPECT_EQ(book.next_frame("nobody/1", seen, 10'000), nullptr);
}

}  // namespace
}  // namespace lifeline::dashboard
