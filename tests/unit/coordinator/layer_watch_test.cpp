#include "coordinator/layer_watch.hpp"

#include <gtest/gtest.h>

#include "common/wire/coarse_cells.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline {
namespace {

std::shared_ptr<const QuantisedTile> wall(double offset_cells) {
  return std::make_shared<const QuantisedTile>(support::wall_tile(0.0, offset_cells));
}

TEST(LayerWatch, NewWallsReviseNothing) {
  LayerWatch watch;
  watch.note({0, 0}, wall(0));
  watch.note({1, 0}, wall(3));
  EXPECT_GT(watch.wall_cells(), 500U);
  EXPECT_EQ(watch.revised_cells(), 0U);
}

TEST(LayerWatch, AWallThatWavesByLessThanACellIsNotRevised) {
  LayerWatch watch;
  watch.note({0, 0}, wall(0.0));
  watch.note({0, 0}, wall(0.5));
  EXPECT_EQ(watch.revised_cells(), 0U);
}

TEST(LayerWatch, AWallThatMovedIsRevisedNearlyWhole) {
  LayerWatch watch;
  watch.note({0, 0}, wall(0));
  const auto before = watch.wall_cells();
  watch.note({0, 0}, wall(4));
  EXPECT_GT(watch.revised_cells(), before / 2);
  EXPECT_NEAR(static_cast<double>(watch.wall_cells()), static_cast<double>(before), 70.0);
}

TEST(LayerWatch, AWallThatIsForgottenIsRevised) {
  LayerWatch watch;
  watch.note({0, 0}, wall(0));
  watch.note({0, 0}, std::make_shared<const QuantisedTile>());
  EXPECT_GT(watch.revised_cells(), 500U / 2);
  EXPECT_EQ(watch.wall_cells(), 0U);
  EXPECT_TRUE(watch.extent(0.05).isEmpty());
}

std::shared_ptr<const QuantisedTile> coarse_wall(double offset_cells,
                                                 const QuantisedTile* held = nullptr) {
  return std::make_shared<const QuantisedTile>(wire::coarse(*wall(offset_cells), held));
}

TEST(LayerWatch, ACoarseWallThatWavesByHalfACellIsNotRevised) {
  LayerWatch watch;
  auto held = coarse_wall(0.0);
  for (int i = 0; i < 60; ++i) {
    watch.note({0, 0}, held);
    held = coarse_wall(0.25 * (i % 3 - 1), held.get());
  }
  EXPECT_EQ(watch.revised_cells(), 0U);
}

TEST(LayerWatch, ACoarseWallThatMovedByTwoCellsIsRevised) {
  for (const double moved : {-2.0, 2.0}) {
    LayerWatch watch;
    const auto held = coarse_wall(0.0);
    watch.note({0, 0}, held);
    const auto before = watch.wall_cells();
    watch.note({0, 0}, coarse_wall(moved, held.get()));
    EXPECT_GT(watch.revised_cells(), before / 10) << moved;  // from 3 % on pairs are matched again
  }
}

TEST(LayerWatch, TheExtentHoldsWhatIsKnownAndNoMore) {
  QuantisedTile tile{};
  tile[offset_in_tile({3, 10})] = {5, 1};
  tile[offset_in_tile({20, 12})] = {5, 1};
  LayerWatch watch;
  watch.note({-1, 2}, std::make_shared<const QuantisedTile>(tile));
  const auto extent = watch.extent(0.05);
  EXPECT_NEAR(extent.min().x(), (-64 + 3) * 0.05, 1e-9);
  EXPECT_NEAR(extent.max().x(), (-64 + 21) * 0.05, 1e-9);
  EXPECT_NEAR(extent.min().y(), (128 + 10) * 0.05, 1e-9);
  EXPECT_NEAR(extent.max().y(), (128 + 13) * 0.05, 1e-9);
}

}  // namespace
}  // namespace lifeline
