#include "common/sharing/fused_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using test::layer;
using test::random_tile;
using test::tile_sample;
using test::tile_samples;

constexpr std::int64_t kCellUm = 50'000;

// The same definition in floating point, cell by cell, with no tile cache: slow and plain.
FusedCell slow_fused_cell(CellIndex cell, const std::vector<FusedMember>& members) {
  double weighted_tsd = 0.0, weight = 0.0;
  for (const auto& member : members) {
    const Pose2 T_layer_fused = to_pose(member.T_fused_layer).inverse();
    const Eigen::Vector2d p =
        T_layer_fused * Eigen::Vector2d((cell.x + 0.5) * 0.05, (cell.y + 0.5) * 0.05);
    const double u = p.x() / 0.05 - 0.5, v = p.y() / 0.05 - 0.5;
    const auto x = static_cast<std::int32_t>(std::floor(u)),
               y = static_cast<std::int32_t>(std::floor(v));
    const auto at = [&](int dx, int dy) {
      const CellIndex i{x + dx, y + dy};
      const auto tile = member.layer->find(tile_of(i));
      return tile == member.layer->end() ? QuantisedCell{}
                                         : (*tile->second.cells)[offset_in_tile(i)];
    };
    const double fx = u - x, fy = v - y;
    if (at(fx >= 0.5 ? 1 : 0, fy >= 0.5 ? 1 : 0).weight == 0) continue;
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        const double share = (dx == 0 ? 1 - fx : fx) * (dy == 0 ? 1 - fy : fy) * at(dx, dy).weight;
        weight += share;
        weighted_tsd += share * at(dx, dy).tsd;
      }
    }
  }
  if (weight == 0.0) return {};
  return {static_cast<std::int8_t>(std::lround(weighted_tsd / weight)),
          static_cast<std::uint8_t>(std::max(1.0, std::min(255.0, std::round(weight))))};
}

class FusedMapTest : public testing::Test {
 protected:
  void hold(const LayerKey& key, TileIndex tile, std::uint64_t revision = 1) {
    ASSERT_TRUE(test::apply(store_, tile_samples(key, tile, revision, random_tile(random_))));
  }
  // Fuses whatever changed in the store.
  void update(FusedMap& map) {
    for (const auto& changed : store_.take_changed()) map.mark(changed);
    map.update(store_);
  }
  FusedMap fused_from_scratch(const std::vector<Placement>& placements) {
    FusedMap map{GridGeometry{}};
    map.place(placements, store_);
    map.update(store_);
    return map;
  }

  std::mt19937 random_{5};
  LayerKey alpha_ = layer("alpha"), bravo_ = layer("bravo");
  ReplicaStore store_{GridGeometry{}};
  const Placement at_origin_{alpha_, to_fixed({0.0, 0.0, 0.0})};
  const Placement turned_{bravo_, to_fixed({1.37, -2.11, 0.7})};
};

TEST_F(FusedMapTest, OneLayerInPlaceFusesToItself) {
  hold(alpha_, {-1, 2});
  const FusedMap map = fused_from_scratch({at_origin_});
  ASSERT_EQ(map.tiles().size(), 1U);
  const auto& cells = *store_.find(alpha_)->at({-1, 2}).cells;
  const auto& fused = map.tiles().at({-1, 2});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ASSERT_EQ(fused[i].tsd, cells[i].tsd);
    ASSERT_EQ(fused[i].weight, cells[i].weight);
  }
}

TEST_F(FusedMapTest, IntegerFusionAgreesWithTheSlowReferenceWithinOneStep) {
  for (const TileIndex tile : {TileIndex{0, 0}, TileIndex{1, 0}, TileIndex{-1, -1}}) {
    hold(alpha_, tile);
    hold(bravo_, tile);
  }
  const std::vector<FusedMember> members = {{store_.find(alpha_), at_origin_.T_fused_layer},
                                            {store_.find(bravo_), turned_.T_fused_layer}};
  int differing = 0;
  for (const TileIndex tile : {TileIndex{0, 0}, TileIndex{0, -1}, TileIndex{1, 0}}) {
    FusedTile fast;
    ASSERT_TRUE(fuse_tile(tile, members, kCellUm, fast));
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const CellIndex cell{first_cell(tile).x + x, first_cell(tile).y + y};
        const FusedCell slow = slow_fused_cell(cell, members);
        const FusedCell quick = fast[offset_in_tile(cell)];
        // Interpolation shares are multiples of 1/256: a random cell may be off by a step of that,
        // a few on an edge by more.
        if (std::abs(quick.tsd - slow.tsd) > 2 || std::abs(quick.weight - slow.weight) > 1)
          ++differing;
      }
    }
  }
  EXPECT_LT(differing, 3 * kTileCells / 100);
}

TEST_F(FusedMapTest, TileByTileUpdatesGiveTheSameBitsAsFusingFromScratch) {
  const std::vector<Placement> placements = {at_origin_, turned_};
  FusedMap map{GridGeometry{}};
  map.place(placements, store_);
  for (std::uint64_t revision = 1; revision <= 3; ++revision) {
    for (const TileIndex tile : {TileIndex{0, 0}, TileIndex{0, 1}, TileIndex{-2, 0}}) {
      hold(alpha_, tile, revision);
      hold(bravo_, tile, revision);
      update(map);
    }
  }
  EXPECT_EQ(map.sha256(), fused_from_scratch(placements).sha256());
  EXPECT_EQ(map.tiles(), fused_from_scratch(placements).tiles());
}

TEST_F(FusedMapTest, TheOrderInWhichMembersAreNamedDoesNotMatter) {
  hold(alpha_, {0, 0});
  hold(bravo_, {0, 0});
  EXPECT_EQ(fused_from_scratch({at_origin_, turned_}).sha256(),
            fused_from_scratch({turned_, at_origin_}).sha256());
}

TEST_F(FusedMapTest, AWithdrawnMemberLeavesNoTrace) {
  hold(alpha_, {0, 0});
  hold(bravo_, {0, 0});
  FusedMap map = fused_from_scratch({at_origin_});
  const auto before = map.sha256();
  map.place({at_origin_, turned_}, store_);
  map.update(store_);
  ASSERT_NE(map.sha256(), before);
  map.place({at_origin_}, store_);
  map.update(store_);
  EXPECT_EQ(map.sha256(), before);
}

TEST_F(FusedMapTest, UpdateNamesExactlyTheTilesThatChanged) {
  hold(alpha_, {0, 0});
  hold(alpha_, {5, 5});
  FusedMap map = fused_from_scratch({at_origin_});
  (void)store_.take_changed();
  hold(alpha_, {5, 5}, 2);
  for (const auto& changed : store_.take_changed()) map.mark(changed);
  EXPECT_EQ(map.update(store_), std::vector<TileIndex>{(TileIndex{5, 5})});
  EXPECT_TRUE(map.update(store_).empty());
}

// The bits that every machine must get; a second implementation in Python integers gives the same.
TEST_F(FusedMapTest, KnownInputsFuseToTheGoldenHash) {
  QuantisedTile stripes;
  for (std::size_t i = 0; i < stripes.size(); ++i) {
    stripes[i] = {static_cast<std::int8_t>(static_cast<int>(i * 7 % 255) - 127),
                  static_cast<std::uint8_t>(1 + i % 15)};
  }
  for (const LayerKey& key : {alpha_, bravo_})
    ASSERT_TRUE(store_.apply(tile_sample(key, {0, 0}, 1, stripes)));
  Placement fixed{bravo_, {}};
  fixed.T_fused_layer = {821190887, 691746206, 1'370'000, -2'110'000};
  EXPECT_EQ(to_hex(fused_from_scratch({at_origin_, fixed}).sha256()),
            "f1bba36640573b06f765f568945f6a30b750c13d6bfde000f8f5dee7a0c592f3");
}

}  // namespace
}  // namespace lifeline::sharing
