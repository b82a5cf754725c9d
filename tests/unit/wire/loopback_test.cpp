#include "common/wire/loopback.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

namespace lifeline::wire {
namespace {

using ::testing::ElementsAre;

TsdTile tile_at(std::int32_t x, std::uint64_t revision, const std::string& agent = "alpha") {
  TsdTile tile;
  tile.layer.agent_id = agent;
  tile.tile_x = x;
  tile.revision = revision;
  return tile;
}

std::vector<std::uint64_t> revisions(const std::vector<TsdTile>& tiles) {
  std::vector<std::uint64_t> found;
  for (const auto& tile : tiles) found.push_back(tile.revision);
  return found;
}

TEST(Loopback, EverySampleReachesEveryReaderInOrder) {
  LoopbackBus bus;
  const auto writer = bus.writer<TsdTile>();
  const auto first = bus.reader<TsdTile>();
  const auto second = bus.reader<TsdTile>();

  ASSERT_TRUE(writer->put(tile_at(3, 1)));
  ASSERT_TRUE(writer->put(tile_at(-2, 2)));

  EXPECT_THAT(revisions(first->take()), ElementsAre(1, 2));
  EXPECT_THAT(revisions(second->take()), ElementsAre(1, 2));
  EXPECT_TRUE(first->take().empty());
}

TEST(Loopback, ANewerSampleReplacesAnUnreadOneOfItsKey) {
  LoopbackBus bus;
  const auto writer = bus.writer<TsdTile>();
  const auto reader = bus.reader<TsdTile>();
  for (const auto& tile : {tile_at(0, 1), tile_at(1, 2), tile_at(0, 3)}) {
    ASSERT_TRUE(writer->put(tile));
  }
  EXPECT_THAT(revisions(reader->take()), ElementsAre(2, 3));
  EXPECT_EQ(reader->refused(), 0U);
}

TEST(Loopback, ALateReaderGetsTheNewestSampleOfEveryKey) {
  LoopbackBus bus;
  const auto alpha = bus.writer<TsdTile>();
  const auto bravo = bus.writer<TsdTile>();
  for (std::uint64_t revision = 1; revision <= 5; ++revision) {
    ASSERT_TRUE(alpha->put(tile_at(0, revision)));
  }
  ASSERT_TRUE(alpha->put(tile_at(1, 6)));
  ASSERT_TRUE(bravo->put(tile_at(0, 7, "bravo")));
  EXPECT_THAT(revisions(bus.reader<TsdTile>()->take()), ElementsAre(5, 6, 7));
}

TEST(Loopback, ALateReaderGetsNothingOfAWriterThatIsGone) {
  LoopbackBus bus;
  ASSERT_TRUE(bus.writer<TsdTile>()->put(tile_at(0, 1)));
  EXPECT_TRUE(bus.reader<TsdTile>()->take().empty());
}

TEST(Loopback, PosesScansAndRequestsAreNotKeptForLateReaders) {
  LoopbackBus bus;
  const auto poses = bus.writer<HelmetPose>();
  const auto scans = bus.writer<HelmetScan>();
  const auto requests = bus.writer<TileRequest>();
  ASSERT_TRUE(poses->put({}));
  ASSERT_TRUE(scans->put({}));
  ASSERT_TRUE(requests->put({}));
  EXPECT_TRUE(bus.reader<HelmetPose>()->take().empty());
  EXPECT_TRUE(bus.reader<HelmetScan>()->take().empty());
  EXPECT_TRUE(bus.reader<TileRequest>()->take().empty());
}

template <typename Message>
class KeptTopics : public ::testing::Test {};
using Kept =
    ::testing::Types<TsdTile, MergeDirective, MergeEvidence, AgentStatus, Detection, Alert>;
TYPED_TEST_SUITE(KeptTopics, Kept);

TYPED_TEST(KeptTopics, ReachLateReaders) {
  LoopbackBus bus;
  const auto writer = bus.writer<TypeParam>();
  TypeParam message;
  message.envelope.sequence = 9;
  ASSERT_TRUE(writer->put(message));
  const auto taken = bus.reader<TypeParam>()->take();
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken.front().envelope.sequence, 9U);
}

TEST(Loopback, AFullReaderDropsTheOldestAndCountsIt) {
  LoopbackBus bus(3);
  const auto writer = bus.writer<TsdTile>();
  const auto reader = bus.reader<TsdTile>();
  for (std::int32_t x = 0; x < 5; ++x) {
    ASSERT_TRUE(writer->put(tile_at(x, static_cast<std::uint64_t>(x) + 1)));
  }
  EXPECT_THAT(revisions(reader->take()), ElementsAre(3, 4, 5));
  EXPECT_EQ(reader->refused(), 2U);
}

TEST(Loopback, AWriterKnowsWhetherAnybodyReads) {
  LoopbackBus bus;
  const auto writer = bus.writer<HelmetScan>();
  EXPECT_FALSE(writer->has_reader());
  auto reader = bus.reader<HelmetScan>();
  EXPECT_TRUE(writer->has_reader());
  reader.reset();
  EXPECT_FALSE(writer->has_reader());
}

TEST(Loopback, WritersAndReadersMayOutliveTheBus) {
  auto bus = std::make_optional<LoopbackBus>();
  const auto writer = bus->writer<Alert>();
  const auto reader = bus->reader<Alert>();
  bus.reset();
  ASSERT_TRUE(writer->put({}));
  EXPECT_EQ(reader->take().size(), 1U);
}

TEST(Loopback, WritersOnSeveralThreadsLoseNothing) {
  constexpr int kWriters = 4, kTiles = 500;
  LoopbackBus bus;
  const auto reader = bus.reader<TsdTile>();
  std::size_t received = 0;
  std::atomic<int> running = kWriters;
  {
    std::vector<std::jthread> threads;
    for (int w = 0; w < kWriters; ++w) {
      threads.emplace_back([&, w] {
        const auto writer = bus.writer<TsdTile>();
        const auto own = bus.reader<TsdTile>();
        for (int i = 0; i < kTiles; ++i) (void)writer->put(tile_at(w * kTiles + i, 1));
        --running;
      });
    }
    while (running > 0) received += reader->take().size();
  }
  received += reader->take().size();
  EXPECT_EQ(received, std::size_t{kWriters} * kTiles);
}

}  // namespace
}  // namespace lifeline::wire
