#include "agents/slam/working_map.hpp"

#include <gtest/gtest.h>

#include "agents/slam/direct_matcher.hpp"
#include "common/grid/ray_cast.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {
namespace {

TsdCell cell(double tsd, int weight) {
  return {static_cast<std::int16_t>(tsd * TsdCell::kTsdOne), static_cast<std::uint16_t>(weight)};
}

std::shared_ptr<TsdTile> tile_of_all(TsdCell value) {
  auto tile = std::make_shared<TsdTile>();
  tile->fill(value);
  return tile;
}

TEST(Blend, FollowsEquation8WhereBothSidesKnow) {
  EXPECT_EQ(blended(cell(0.5, 64), cell(-0.5, 64), 0.5).tsd, 0);
  EXPECT_EQ(blended(cell(0.5, 64), cell(0.1, 64), 0.75).tsd, cell(0.4, 1).tsd);
  EXPECT_EQ(blended(cell(0.5, 64), cell(0.1, 64), 1.0).tsd, cell(0.5, 1).tsd);
}

TEST(Blend, TakesTheOneSideThatKnows) {
  EXPECT_EQ(blended({}, cell(0.1, 3), 0.9), cell(0.1, 3));
  EXPECT_EQ(blended(cell(0.1, 3), {}, 0.1), cell(0.1, 3));
  EXPECT_FALSE(blended({}, {}, 0.5).known());
}

TEST(WorkingMap, WithoutPeersIsTheLayerItself) {
  WorkingMap map(kGeometry);
  TsdTile& own = map.own().at({1, 2});
  EXPECT_EQ(map.find({1, 2}), &own);
  EXPECT_EQ(map.find({0, 0}), nullptr);
  EXPECT_FALSE(map.has_peers());
}

TEST(WorkingMap, ShowsPeersCellsWhereTheOwnLayerHasNone) {
  WorkingMap map(kGeometry);
  map.set_peer_tile({3, 3}, tile_of_all(cell(0.2, 64)));
  ASSERT_NE(map.find({3, 3}), nullptr);
  EXPECT_EQ((*map.find({3, 3}))[7], cell(0.2, 64));
  EXPECT_EQ(map.own().find({3, 3}), nullptr);
}

TEST(WorkingMap, TheOwnLayerIsNeverChangedByPeers) {
  WorkingMap map(kGeometry);
  map.own().at({0, 0}).fill(cell(0.6, 64));
  map.set_peer_tile({0, 0}, tile_of_all(cell(0.2, 64)));
  EXPECT_EQ((*map.find({0, 0}))[0].tsd, cell(0.4, 1).tsd);
  EXPECT_EQ((*map.own().find({0, 0}))[0], cell(0.6, 64));
}

TEST(WorkingMap, FollowsChangesOfEitherSideAndOfTheWeight) {
  WorkingMap map(kGeometry);
  const TileIndex tile{0, 0};
  map.own().at(tile).fill(cell(0.6, 64));
  map.set_peer_tile(tile, tile_of_all(cell(0.2, 64)));
  ASSERT_EQ((*map.find(tile))[0].tsd, cell(0.4, 1).tsd);
  map.own().at(tile).fill(cell(0.8, 64));
  map.note_own_changed(std::span(&tile, 1));
  EXPECT_EQ((*map.find(tile))[0].tsd, cell(0.5, 1).tsd);
  map.set_peer_tile(tile, tile_of_all(cell(0.0, 64)));
  EXPECT_EQ((*map.find(tile))[0].tsd, cell(0.4, 1).tsd);
  map.set_own_weight(0.25);
  EXPECT_EQ((*map.find(tile))[0].tsd, cell(0.2, 1).tsd);
  map.set_peer_tile(tile, nullptr);
  EXPECT_EQ((*map.find(tile))[0].tsd, cell(0.8, 1).tsd);
}

TEST(WorkingMap, ForgetsAllPeersAtOnce) {
  WorkingMap map(kGeometry);
  map.set_peer_tile({0, 0}, tile_of_all(cell(0.2, 64)));
  map.set_peer_tile({5, 0}, tile_of_all(cell(0.2, 64)));
  map.clear_peers();
  EXPECT_FALSE(map.has_peers());
  EXPECT_EQ(map.find({5, 0}), nullptr);
}

/// A layer of the small flat, seen from a few places.
TsdGrid flat_layer() {
  TsdGrid grid(kGeometry);
  TsdUpdater updater(kGeometry, {});
  for (const Pose2& T : {Pose2{0.0, 0.0, 0.0}, Pose2{0.8, 0.6, 1.0}, Pose2{-1.0, 1.0, 2.0}}) {
    const auto scan = support::scan_of(support::small_flat(), T);
    (void)updater.push(extract_surface(scan), T, 1.0, grid);
  }
  return grid;
}

TEST(WorkingMap, ScansMatchAndRayCastAgainstPeersCellsAlone) {
  const TsdGrid peer = flat_layer();
  WorkingMap map(kGeometry);
  for (const TileIndex tile : peer.tiles()) {
    map.set_peer_tile(tile, std::make_shared<const TsdTile>(*peer.find(tile)));
  }
  const Pose2 truth{0.4, 0.3, 0.5};
  const Scan2 scan = support::scan_of(support::small_flat(), truth);
  TsdView view;
  view.assign(map, truth.translation(), 15.0);
  DirectMatcher matcher({});
  matcher.set_scan(extract_surface(scan));
  const Pose2 found = matcher.align(view, Prediction{{0.45, 0.27, 0.47}, 0.2, 0.1});
  EXPECT_LT((found.translation() - truth.translation()).norm(), 0.01);
  EXPECT_GT(ray_cast(view, truth, scan, 30.0).size(), 300U);
}

}  // namespace
}  // namespace lifeline::slam
