#include "common/store/tile_records.hpp"

#include <random>

#include <gtest/gtest.h>

#include "common/store/packed_cells.hpp"
#include "common/wire/tile_codec.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::store {
namespace {

TsdTile random_layer_tile(std::mt19937& random) {
  TsdTile tile;
  for (TsdCell& cell : tile) {
    if (random() % 3 == 0) continue;
    cell.weight = static_cast<std::uint16_t>(1 + random() % 65535);
    cell.tsd = static_cast<std::int16_t>(static_cast<int>(random() % 64001) - TsdCell::kTsdOne);
  }
  return tile;
}

TEST(PackedCells, GiveTheSameCells) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const TsdTile layer = random_layer_tile(random);
    EXPECT_EQ(unpack_layer_cells(pack_cells(layer)), layer);
    const QuantisedTile published = test::random_tile(random);
    EXPECT_EQ(unpack_published_cells(pack_cells(published)), published);
  }
  EXPECT_EQ(unpack_layer_cells(pack_cells(TsdTile{})), TsdTile{});
}

TEST(PackedCells, OfOtherOctetsAreRefused) {
  std::mt19937 random(4);
  const std::string frame = pack_cells(test::small_tile(random));
  EXPECT_FALSE(unpack_layer_cells(frame)) << "of the other kind";
  EXPECT_FALSE(unpack_published_cells(""));
  for (std::size_t cut = 0; cut < frame.size(); ++cut) {
    EXPECT_FALSE(unpack_published_cells(std::string_view(frame).substr(0, cut)));
  }
  for (int i = 0; i < 2000; ++i) {
    std::string broken = frame;
    broken[random() % broken.size()] = static_cast<char>(random());
    if (const auto cells = unpack_published_cells(broken)) {
      for (const QuantisedCell cell : *cells) {
        ASSERT_LE(std::abs(int{cell.tsd}), QuantisedCell::kTsdOne);
        ASSERT_LE(cell.weight, QuantisedCell::kMaxWeight);
      }
    }
  }
}

TEST(PackedCells, WithValuesThatNoCellHasAreRefused) {
  TsdTile tile;
  tile[7].tsd = 5;  // known is what has a weight
  EXPECT_FALSE(unpack_layer_cells(pack_cells(tile)));
  QuantisedTile published;
  published[7] = {0, QuantisedCell::kMaxWeight + 1};
  EXPECT_FALSE(unpack_published_cells(pack_cells(published)));
}

TEST(TileRecords, GiveTheSameTiles) {
  std::mt19937 random(5);
  const LayerKey own = test::layer("alpha", 3, -2), other = test::layer("b.r-a_vo", 1);
  const QuantisedTile a = test::random_tile(random), b = test::random_tile(random);
  const auto payload = wire::encode_tile(a, GridGeometry{});
  const Records records{{published_key(own, {-3, 4}), own_tile_record(Revision{9}, payload)},
                        {published_key(other, {0, -1}), peer_tile_record(Revision{1U << 30U}, b)},
                        {"something else", "x"}};
  const auto layers = read_tiles(records, GridGeometry{});
  ASSERT_TRUE(layers) << layers.error().text;
  ASSERT_EQ(layers->size(), 2U);
  const auto& kept = layers->at(own).at({-3, 4});
  EXPECT_EQ(kept.revision, Revision{9});
  EXPECT_EQ(kept.payload, payload);
  EXPECT_EQ(*kept.cells, a);
  EXPECT_EQ(*layers->at(other).at({0, -1}).cells, b);
  EXPECT_EQ(layers->at(other).at({0, -1}).revision, Revision{1U << 30U});
}

TEST(TileRecords, OfBrokenKeysOrValuesAreRefused) {
  const std::string good = peer_tile_record(Revision{1}, QuantisedTile{});
  for (const char* key : {"tile/", "tile/alpha/1/0/1", "tile/alpha/1/0/1/2/3",
                          "tile/al pha/1/0/1/2", "tile/alpha/-1/0/1/2", "tile/alpha/1/99999/1/2",
                          "tile/alpha/1/0/1/99999999", "tile/alpha/1/0/x/2"}) {
    const auto layers = read_tiles({{key, good}}, GridGeometry{});
    ASSERT_FALSE(layers) << key;
    EXPECT_EQ(layers.error().text.find('\n'), std::string::npos);
  }
  const std::string key = published_key(test::layer("alpha"), {1, 2});
  EXPECT_FALSE(read_tiles({{key, "rubbish"}}, GridGeometry{}));
  EXPECT_FALSE(read_tiles({{key, peer_tile_record(Revision{0}, QuantisedTile{})}}, GridGeometry{}));
  EXPECT_FALSE(read_tiles({{key, own_tile_record(Revision{1}, {1, 2, 3})}}, GridGeometry{}));
}

TEST(TileRecords, GiveTheSameDirective) {
  wire::MergeDirective directive;
  directive.mission_id = "drill";
  directive.epoch = 77;
  directive.own_weight_permille = 321;
  directive.members = {
      {{"alpha", 1, 0}, 0, {}, {}, 1.0F},
      {{"bravo", 2, -1}, 0, {0, wire::FixedTransform::kOne, -5, 7}, {1, 2, 3, 4, 5, 6}, 0.25F}};
  const auto read = read_directive({{kDirectiveKey, directive_record(directive)}}, "drill");
  ASSERT_TRUE(read && *read);
  EXPECT_EQ((*read)->epoch, 77U);
  EXPECT_EQ((*read)->own_weight_permille, 321);
  ASSERT_EQ((*read)->members.size(), 2U);
  const auto& bravo = (*read)->members[1];
  EXPECT_EQ(bravo.layer, directive.members[1].layer);
  EXPECT_EQ(bravo.T_common_map, directive.members[1].T_common_map);
  EXPECT_EQ(bravo.covariance, directive.members[1].covariance);
  EXPECT_EQ(bravo.quality, 0.25F);
  EXPECT_FALSE(*read_directive({}, "drill"));
  EXPECT_FALSE(read_directive({{kDirectiveKey, "\xff"}}, "drill"));
  directive.members[1].T_common_map.cos_q30 = wire::FixedTransform::kOne;  // no rotation any more
  EXPECT_FALSE(read_directive({{kDirectiveKey, directive_record(directive)}}, "drill"));
}

}  // namespace
}  // namespace lifeline::store
