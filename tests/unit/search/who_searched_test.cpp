#include "common/search/who_searched.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"

namespace lifeline::search {
namespace {

using testing::DoubleNear;

constexpr double kTileM2 = 3.2 * 3.2;

LayerKey layer(const char* id) {
  return {AgentId::parse(id).value(), MapId{1}, Floor{0}};
}

/// Known from column `from` to `to` (without it).
QuantisedTile known(int from = 0, int to = kTileSide) {
  QuantisedTile cells{};
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = from; x < to; ++x) cells[static_cast<std::size_t>(y * kTileSide + x)] = {90, 4};
  }
  return cells;
}

class WhoSearchedTest : public testing::Test {
 protected:
  /// The common map as it is fused of all that was noted.
  void see(const char* id, TileIndex tile, const QuantisedTile& cells) {
    who_.note(layer(id), tile, cells);
    auto& fused = fused_[tile];
    for (std::size_t i = 0; i < fused.size(); ++i)
      if (cells[i].weight > 0) fused[i] = {cells[i].tsd, cells[i].weight};
    refresh();
  }
  void place(const std::vector<sharing::Placement>& placements) {
    who_.place(placements);
    refresh();
  }
  void refresh() {
    for (const auto& [tile, cells] : fused_) who_.refresh(tile, &cells);
  }
  WhoSearched who_{0.05};
  std::map<TileIndex, sharing::FusedTile> fused_;
};

TEST_F(WhoSearchedTest, TheFirstKeepsAPlaceAndTheSecondHasSeenIt) {
  place({{layer("alpha"), {}}, {layer("bravo"), {}}});
  see("bravo", {0, 0}, known());
  see("alpha", {0, 0}, known());
  see("alpha", {1, 0}, known(0, 32));
  EXPECT_THAT(who_.helmets(), testing::ElementsAre("alpha", "bravo"));
  const auto shares = who_.shares();
  EXPECT_THAT(shares[0].first_m2, DoubleNear(0.5 * kTileM2, 1e-9));
  EXPECT_THAT(shares[0].seen_m2, DoubleNear(1.5 * kTileM2, 1e-9));
  EXPECT_THAT(shares[1].first_m2, DoubleNear(kTileM2, 1e-9));
  EXPECT_THAT(shares[1].seen_m2, DoubleNear(kTileM2, 1e-9));
  EXPECT_THAT(who_.searched_m2(), DoubleNear(1.5 * kTileM2, 1e-9));
}

TEST_F(WhoSearchedTest, ALayerCountsWhereItLies) {
  place({{layer("alpha"), sharing::to_fixed({3.2, 0.0, 0.0})}});
  see("alpha", {0, 0}, known());
  EXPECT_EQ(who_.searched_m2(), 0.0) << "its tile lies on another one";
  fused_[{1, 0}] = fused_[{0, 0}];
  refresh();
  EXPECT_THAT(who_.searched_m2(), DoubleNear(kTileM2, 1e-9));
}

TEST_F(WhoSearchedTest, AWithdrawnMergeLeavesNoTrace) {
  place({{layer("alpha"), {}}, {layer("bravo"), {}}});
  see("bravo", {0, 0}, known());
  see("alpha", {0, 0}, known());
  place({{layer("alpha"), {}}});
  EXPECT_THAT(who_.shares()[0].first_m2, DoubleNear(kTileM2, 1e-9));
  EXPECT_EQ(who_.shares()[1].seen_m2, 0.0);
  EXPECT_EQ(who_.helmets().size(), 2U) << "numbers stay";
}

TEST_F(WhoSearchedTest, ATileThatIsGoneIsNobodys) {
  place({{layer("alpha"), {}}});
  see("alpha", {0, 0}, known());
  who_.refresh({0, 0}, nullptr);
  EXPECT_TRUE(who_.owners().empty());
  EXPECT_EQ(who_.shares()[0].seen_m2, 0.0);
}

TEST_F(WhoSearchedTest, APlaceThatALayerNoLongerKnowsIsNotItsAnyMore) {
  place({{layer("alpha"), {}}, {layer("bravo"), {}}});
  see("alpha", {0, 0}, known());
  see("bravo", {0, 0}, known());
  see("alpha", {0, 0}, known(32));
  EXPECT_THAT(who_.shares()[0].first_m2, DoubleNear(0.5 * kTileM2, 1e-9));
  EXPECT_THAT(who_.shares()[1].first_m2, DoubleNear(0.5 * kTileM2, 1e-9));
}

}  // namespace
}  // namespace lifeline::search
