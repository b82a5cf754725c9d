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
