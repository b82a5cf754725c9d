#include "coordinator/match_worker.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::test {
namespace {

constexpr std::chrono::seconds kDeadline{60};

sharing::ReplicaLayer layer_of(double angle_rad) {
  sharing::ReplicaLayer layer;
  for (int x = 0; x < 3; ++x) {
    const auto cells = std::make_shared<const QuantisedTile>(support::wall_tile(angle_rad + x));
    layer[{x, 0}] = {Revision{1}, cells};
  }
  return layer;
}

MatchJob job(std::size_t changes) {
  return {{layer("ada"), 1000, false, changes},
          {layer("ben"), 1000, false, changes},
          layer_of(0.3),
          layer_of(0.1 * static_cast<double>(changes)),
          GridGeometry{}};
}

std::optional<MatchOutcome> wait_for(MatchWorker& worker) {
  const auto give_up = std::chrono::steady_clock::now() + kDeadline;
  while (std::chrono::steady_clock::now() < give_up) {
    if (auto outcome = worker.take()) return outcome;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

/// What the matcher sees of a layer and its copy `tiles` farther along x, laid on it by T.
std::optional<merging::PlaceCheck> check_copy(int tiles, const std::optional<Pose2>& T_a_b) {
  MatchJob copy = job(1);
  copy.layer_a = layer_of(0.3);
  copy.layer_b.clear();
  for (const auto& [tile, cells] : copy.layer_a) copy.layer_b[{tile.x + tiles, tile.y}] = cells;
  copy.check_T_a_b = T_a_b;
  InlineMatchWorker worker(matching::MatchConfig{});
  worker.submit(std::move(copy));
  return worker.take()->check;
}

TEST(InlineMatchWorker, LooksAtThePlaceThatItIsAskedFor) {
  const double tile_m = kTileSide * GridGeometry{}.cell_size_m;
  const auto same = check_copy(0, Pose2{}), moved = check_copy(5, Pose2{-5 * tile_m, 0.0, 0.0});
  ASSERT_TRUE(same && moved);
  EXPECT_GT(same->figures.agreeing_wall_m, 3.0);
  EXPECT_EQ(same->figures.conflict, 0.0);
  EXPECT_NEAR(moved->figures.agreeing_wall_m, same->figures.agreeing_wall_m, 0.2);
  EXPECT_NEAR(moved->overlap_centre_b_m.x(), same->overlap_centre_b_m.x() + 5 * tile_m, 0.1);
  EXPECT_EQ(moved->figures.T_a_b.x_m, -5 * tile_m);
}

TEST(InlineMatchWorker, FindsWallsThatContradictThere) {
  const auto shifted = check_copy(0, Pose2{0.8, 0.4, 0.0});
  ASSERT_TRUE(shifted);
  EXPECT_LT(shifted->figures.agreeing_wall_m, 3.0);
  EXPECT_GT(shifted->conflict_m, 1.0);
}

TEST(InlineMatchWorker, LooksNowhereUnasked) {
  EXPECT_FALSE(check_copy(0, std::nullopt));
}

TEST(ThreadedMatchWorker, FindsWhatTheInlineOneFinds) {
  ThreadedMatchWorker threaded(matching::MatchConfig{});
  InlineMatchWorker inline_worker(matching::MatchConfig{});
  for (std::size_t changes = 1; changes <= 4; ++changes) {
    threaded.submit(job(changes));
    EXPECT_TRUE(threaded.busy());
    inline_worker.submit(job(changes));
    const auto found = wait_for(threaded), expected = inline_worker.take();
    ASSERT_TRUE(found && expected);
    EXPECT_FALSE(threaded.busy());
    EXPECT_EQ(found->a.layer, layer("ada"));
    EXPECT_EQ(found->b.changes, changes);
    EXPECT_EQ(found->result.verdict, expected->result.verdict);
    EXPECT_EQ(found->result.candidates.size(), expected->result.candidates.size());
  }
}

TEST(ThreadedMatchWorker, TheCallersTilesMayChangeWhileItMatches) {
  ThreadedMatchWorker worker(matching::MatchConfig{});
  sharing::ReplicaLayer live = layer_of(0.3);
  MatchJob shared = job(1);
  shared.layer_a = live;  // cells are shared, as the coordinator's replicas are
  worker.submit(std::move(shared));
  for (int i = 0; i < 200; ++i) {
    const auto cells = std::make_shared<const QuantisedTile>(support::wall_tile(0.01 * i));
    live[{i % 3, 0}] = {Revision{static_cast<std::uint64_t>(i + 2)}, cells};
  }
  EXPECT_TRUE(wait_for(worker));
}

TEST(ThreadedMatchWorker, GoesAwayIdleBusyAndWithAnOutcomeUntaken) {
  { const ThreadedMatchWorker idle(matching::MatchConfig{}); }
  for (const int wait_ms : {0, 1, 200}) {
    ThreadedMatchWorker busy(matching::MatchConfig{});
    busy.submit(job(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    EXPECT_TRUE(busy.busy());
  }
}

}  // namespace
}  // namespace lifeline::test
