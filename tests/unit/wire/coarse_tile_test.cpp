#include "common/wire/coarse_tile.hpp"

#include <random>

#include <gtest/gtest.h>

#include "common/wire/coarse_cells.hpp"
#include "common/wire/limits.hpp"
#include "common/wire/tile_codec.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::wire {
namespace {

TEST(CoarseTile, AnyTileIsCoarseOnceItWasMadeSo) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const QuantisedTile fine = support::random_tile(random, 0.02 * i);
    const QuantisedTile tile = coarse(fine);
    ASSERT_TRUE(is_coarse(tile));
    for (std::size_t k = 0; k < tile.size(); ++k) {
      ASSERT_EQ(tile[k].weight != 0, fine[k].weight != 0);
      if (fine[k].weight == 0) continue;
      ASSERT_EQ(tile[k].tsd > 0, fine[k].tsd > 0) << int{fine[k].tsd};
    }
  }
  EXPECT_FALSE(is_coarse(support::random_tile(random, 0.5)));
}

TEST(CoarseTile, ComesBackBitForBit) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const QuantisedTile tile = coarse(i % 2 == 0 ? support::random_tile(random, 0.01 * i)
                                                 : support::wall_tile(0.0631 * i, i % 17 - 8.0));
    const auto payload = encode_tile(tile, kGeometry);
    ASSERT_LE(payload.size(), kMaxTilePayload);
    ASSERT_EQ(payload.front(), 0x08);
    const auto decoded = decode_tile(payload, kGeometry);
    ASSERT_TRUE(decoded) << decoded.error().text;
    ASSERT_EQ(*decoded, tile) << i;
  }
}

TEST(CoarseTile, AWallTakesLessThanAThirdOfTheFineOne) {
  const auto fine = support::wall_tile(0.7);
  EXPECT_LT(10 * encode_tile(coarse(fine), kGeometry).size(),
            3 * encode_tile(fine, kGeometry).size());
  EXPECT_LT(encode_tile(coarse(fine), kGeometry).size(), 200U);
}

TEST(CoarseTile, EveryFlippedBitAndEveryTruncationIsRefused) {
  const auto payload = encode_tile(coarse(support::wall_tile(0.4)), kGeometry);
  for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
    auto damaged = payload;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    const auto tile = decode_tile(damaged, kGeometry);
    ASSERT_FALSE(tile) << bit;
    ASSERT_EQ(tile.error().text.find('\n'), std::string::npos);
  }
  for (std::size_t size = 0; size < payload.size(); ++size)
    ASSERT_FALSE(decode_tile({payload.data(), size}, kGeometry)) << size;
}

TEST(CoarseTile, RefusesOtherCellsAndWhatFollows) {
  const GridGeometry other{.cell_size_m = 0.1, .truncation_m = 0.15};
  auto payload = encode_tile(coarse(support::wall_tile(0.4)), other);
  EXPECT_TRUE(decode_tile(payload, other));
  const auto tile = decode_tile(payload, kGeometry);
  ASSERT_FALSE(tile);
  EXPECT_NE(tile.error().text.find("map of other cell size"), std::string::npos);
  payload.insert(payload.end(), {0x78, 0x01});  // a field that there is not
  EXPECT_FALSE(decode_tile(payload, other));
}

TEST(CoarseTile, AnyOctetsStandForACoarseTile) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::uint8_t> octets(random() % 600U);
    for (auto& octet : octets) octet = static_cast<std::uint8_t>(random());
    const QuantisedTile tile = decode_cells(octets);
    ASSERT_TRUE(is_coarse(tile));
    ASSERT_EQ(decode_cells(encode_cells(tile)), tile);
  }
}

TEST(CoarseTileDeath, AFineTileIsABug) {
  EXPECT_DEATH((void)encode_cells(support::wall_tile(0.3)), "is_coarse");
}

}  // namespace
}  // namespace lifeline::wire
