#include "common/wire/coarse_cells.hpp"
#include "common/wire/tile_codec.hpp"
#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::sharing {
namespace {

TEST_F(HelmetSharingTest, HelmetsThatFollowOneDirectiveHoldTheSameMapToTheBit) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  alpha->put(random_tiles({{0, 0}, {1, 0}}));
  bravo->put(random_tiles({{0, 0}, {0, -1}}));
  direct(1, {{"alpha", {}}, {"bravo", {0.7, -1.3, 2.2}}});
  run({alpha.get(), bravo.get()});
  EXPECT_EQ(alpha->tiles_behind(), 0U);
  ASSERT_TRUE(alpha->map().shares());
  EXPECT_EQ(to_hex(alpha->map().common_map_sha256()), to_hex(bravo->map().common_map_sha256()));
  EXPECT_EQ(alpha->map().fingerprint(), bravo->map().fingerprint());
  EXPECT_NE(alpha->map().fingerprint(), RevisionDigest{});
}

TEST_F(HelmetSharingTest, ALateJoinerCatchesUp) {
  auto alpha = make_helmet("alpha");
  alpha->put(random_tiles({{0, 0}, {4, 2}}));
  run({alpha.get()});
  alpha->put(random_tiles({{0, 0}}));
  direct(1, {{"alpha", {}}, {"bravo", {1.0, 0.0, 0.1}}});
  run({alpha.get()});
  auto bravo = make_helmet("bravo");
  run({alpha.get(), bravo.get()});
  EXPECT_EQ(to_hex(alpha->map().common_map_sha256()), to_hex(bravo->map().common_map_sha256()));
}

TEST_F(HelmetSharingTest, AnOlderDirectiveIsRefused) {
  auto alpha = make_helmet("alpha");
  direct(5, {{"alpha", {}}, {"bravo", {1.0, 0.0, 0.0}}});
  run({alpha.get()});
  direct(4, {{"alpha", {}}, {"bravo", {9.0, 0.0, 0.0}}});
  run({alpha.get()});
  EXPECT_EQ(alpha->map().epoch(), Epoch{5});
  EXPECT_EQ(alpha->map().common_map().placements()[1].T_fused_layer.x_um, 1'000'000);
}

TEST_F(HelmetSharingTest, AWithdrawnMergeLeavesNoTraceInMapOrPeers) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  alpha->put(random_tiles({{0, 0}}));
  bravo->put(random_tiles({{0, 0}}));
  direct(1, {{"alpha", {}}, {"bravo", {0.2, 0.0, 0.0}}});
  run({alpha.get(), bravo.get()});
  const auto merged = alpha->take_peer_update();
  ASSERT_TRUE(merged);
  EXPECT_TRUE(std::any_of(merged->tiles.begin(), merged->tiles.end(),
                          [](const auto& tile) { return tile.second; }));
  direct(2, {});
  run({alpha.get(), bravo.get()});
  EXPECT_FALSE(alpha->map().shares());
  EXPECT_TRUE(alpha->map().common_map().tiles().empty());
  const auto withdrawn = alpha->take_peer_update();
  ASSERT_TRUE(withdrawn);
  EXPECT_TRUE(std::all_of(withdrawn->tiles.begin(), withdrawn->tiles.end(),
                          [](const auto& tile) { return !tile.second; }));
}

TEST_F(HelmetSharingTest, PeersArriveInTheHelmetsOwnFrame) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  const auto tiles = random_tiles({{0, 0}});
  bravo->put(tiles);
  // Both lie one tile to the right of the common origin: to alpha, bravo's tile is where its own
  // (0, 0) is.
  direct(1, {{"alpha", {3.2, 0.0, 0.0}}, {"bravo", {3.2, 0.0, 0.0}}});
  run({alpha.get(), bravo.get()});
  const auto peers = alpha->take_peer_update();
  ASSERT_TRUE(peers);
  ASSERT_EQ(peers->tiles.size(), 1U);
  EXPECT_EQ(peers->tiles[0].first, (TileIndex{0, 0}));
  EXPECT_EQ(*peers->tiles[0].second, dequantise(*tiles[0].second));
  EXPECT_TRUE(alpha->map().store().layers().contains(layer("bravo")));
}

TEST_F(HelmetSharingTest, OnlyWhatWasPublishedEntersTheOwnCommonMap) {
  budget_bit_s_ = 64000;
  auto alpha = make_helmet("alpha");
  alpha->put(random_tiles({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}));
  run({alpha.get()}, milliseconds(500));
  ASSERT_GT(alpha->tiles_behind(), 0U);
  EXPECT_EQ(alpha->map().store().find(layer("alpha"))->size() + alpha->tiles_behind(), 6U);
}

TEST_F(HelmetSharingTest, AnUnchangedTileIsNotSentAgain) {
  auto alpha = make_helmet("alpha");
  auto reader = bus_.reader<wire::TsdTile>();
  const auto tiles = random_tiles({{0, 0}});
  alpha->put(tiles);
  run({alpha.get()});
  const auto parts = reader->take();
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts.size(), parts.front().parts);
  alpha->put(tiles);
  run({alpha.get()});
  EXPECT_TRUE(reader->take().empty());
  EXPECT_EQ(alpha->tiles_behind(), 0U);
}

TEST_F(HelmetSharingTest, ACoarseHelmetFusesAndSendsTheSameCoarseCells) {
  publisher_.coarse = true;
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  const auto tiles = random_tiles({{0, 0}});
  alpha->put(tiles);
  run({alpha.get(), bravo.get()});
  const QuantisedTile expected = wire::coarse(*tiles[0].second);
  ASSERT_NE(expected, *tiles[0].second);
  EXPECT_EQ(*alpha->map().store().find(layer("alpha"))->at({0, 0}).cells, expected);
  EXPECT_EQ(*bravo->map().store().find(layer("alpha"))->at({0, 0}).cells, expected);
}

TEST_F(HelmetSharingTest, SamplesOfAnotherMissionAreRefusedAndCounted) {
  auto alpha = make_helmet("alpha");
  auto writer = bus_.writer<wire::TsdTile>();
  auto foreign = test::tile_sample(layer("zulu"), {0, 0}, 1, test::small_tile(random_));
  foreign.envelope.mission_id = "another";
  ASSERT_TRUE(writer->put(foreign));
  run({alpha.get()});
  EXPECT_EQ(alpha->refused(), 1U);
  EXPECT_TRUE(alpha->map().store().layers().empty());
}

TEST_F(HelmetSharingTest, SaysSoWhenAnotherUsesItsId) {
  auto first = make_helmet("alpha", 1), second = make_helmet("alpha", 2);
  run({first.get(), second.get()});
  EXPECT_TRUE(first->status().duplicate_id_heard);
  EXPECT_TRUE(second->status().duplicate_id_heard);
}

TEST_F(HelmetSharingTest, NothingIsPublishedBeforeTheFirstPose) {
  auto alpha = make_helmet("alpha");
  alpha->put(HelmetState{});
  auto poses = bus_.reader<wire::HelmetPose>();
  run({alpha.get()});
  EXPECT_TRUE(poses->take().empty());
}

TEST_F(HelmetSharingTest, ALargeTeamSharesAHundredPosesASecond) {
  budget_bit_s_ = 50e6;
  auto alpha = make_helmet("alpha");
  auto poses = bus_.reader<wire::HelmetPose>();
  auto statuses = bus_.writer<wire::AgentStatus>();
  std::uint64_t sequence = 0;
  const auto count_poses = [&](int peers) {
    std::size_t sent = 0;
    for (int second = 0; second < 10; ++second) {
      for (int peer = 0; peer < peers; ++peer) {
        wire::AgentStatus status;
        status.agent_id = "peer" + std::to_string(peer);
        status.envelope = test::envelope(status.agent_id, ++sequence);
        EXPECT_TRUE(statuses->put(status));
      }
      for (int step = 0; step < 20; ++step) {
        run({alpha.get()}, milliseconds(50));
        sent += poses->take().size();
      }
    }
    return sent;
  };
  EXPECT_NEAR(static_cast<double>(count_poses(8)), 100.0, 2.0) << "a small one needs not";
  EXPECT_NEAR(static_cast<double>(count_poses(32)), 29.0, 3.0) << "one in 350 ms, of steps of 50";
}

class MissionJoinTest : public HelmetSharingTest {
 protected:
  std::optional<Result<MapId>> join(std::uint64_t incarnation, HelmetSharing* present = nullptr) {
    MissionJoin join(speaker("alpha", incarnation), Floor{0}, milliseconds(1500), *outbox_, *inbox_,
                     clock_);
    for (int i = 0; i < 100; ++i) {
      clock_.advance(milliseconds(50));
      if (present != nullptr) present->step();
      if (auto answer = join.step()) return answer;
    }
    return std::nullopt;
  }
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> outbox_ = bus_.writer<wire::AgentStatus>();
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> inbox_ = bus_.reader<wire::AgentStatus>();
};

TEST_F(MissionJoinTest, TheFirstMapIsNumberOne) {
  const auto answer = join(5);
  ASSERT_TRUE(answer && *answer);
  EXPECT_EQ(**answer, MapId{1});
}

TEST_F(MissionJoinTest, ATakenIdIsRefusedAndTheHolderSaysSo) {
  auto holder = make_helmet("alpha", 9);
  const auto answer = join(5, holder.get());
  ASSERT_TRUE(answer);
  ASSERT_FALSE(*answer);
  EXPECT_NE(answer->error().text.find("calls itself alpha already"), std::string::npos);
  holder->step();
  EXPECT_TRUE(holder->status().duplicate_id_heard);
}

TEST_F(MissionJoinTest, ARebootedHelmetStartsANewMapWhileTheOldOneIsRemembered) {
  auto before = make_helmet("alpha", 1), bravo = make_helmet("bravo");
  before->put(random_tiles({{0, 0}}));
  run({before.get(), bravo.get()});
  before.reset();
  (void)inbox_->take();
  const auto answer = join(2, bravo.get());
  ASSERT_TRUE(answer && *answer);
  EXPECT_EQ(**answer, MapId{2});
}

TEST_F(MissionJoinTest, OfTwoThatStartAtOnceExactlyOneStays) {
  MissionJoin small(speaker("alpha", 3), Floor{0}, milliseconds(1500), *outbox_, *inbox_, clock_);
  auto other_inbox = bus_.reader<wire::AgentStatus>();
  MissionJoin large(speaker("alpha", 4), Floor{0}, milliseconds(1500), *outbox_, *other_inbox,
                    clock_);
  std::optional<Result<MapId>> small_answer, large_answer;
  for (int i = 0; i < 100 && !(small_answer && large_answer); ++i) {
    clock_.advance(milliseconds(50));
    if (!small_answer) small_answer = small.step();
    if (!large_answer) large_answer = large.step();
  }
  ASSERT_TRUE(small_answer && large_answer);
  EXPECT_TRUE(small_answer->has_value());
  EXPECT_FALSE(large_answer->has_value());
}

// It was killed while its disk took nothing: others hold a newer tile than it goes on with, and one
// that it has never heard of.
TEST_F(HelmetSharingTest, OneThatGoesOnFromAnOlderStateOutranksWhatItDoesNotKnow) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  const MapTiles old = random_tiles({{0, 0}, {1, 0}});
  alpha->put(old);
  run({alpha.get(), bravo.get()});
  SharingMemory memory;
  for (const auto& [tile, cells] : old) {
    const Revision revision = alpha->map().store().find(layer("alpha"))->at(tile).revision;
    memory.layers[layer("alpha")][tile] = {revision, wire::encode_tile(*cells, {}), cells};
  }
  memory.newest_before = Revision{1 << 24};
  alpha->put(random_tiles({{1, 0}, {2, 0}}));
  run({alpha.get(), bravo.get()});
  alpha.reset();

  alpha = make_helmet("alpha", 2);
  ASSERT_TRUE(alpha->resume(memory));
  run({alpha.get(), bravo.get()}, std::chrono::seconds(20));
  const ReplicaLayer& own = *alpha->map().store().find(layer("alpha"));
  const ReplicaLayer& held = *bravo->map().store().find(layer("alpha"));
  ASSERT_EQ(own.size(), 3U);
  ASSERT_EQ(held.size(), 3U);
  for (const auto& [tile, replica] : own) {
    EXPECT_EQ(held.at(tile).revision, replica.revision);
    EXPECT_EQ(*held.at(tile).cells, *replica.cells);
  }
  EXPECT_LT(held.at({0, 0}).revision, memory.newest_before) << "was known: not said again";
  EXPECT_EQ(*held.at({1, 0}).cells, *old[1].second);
  EXPECT_EQ(*held.at({2, 0}).cells, QuantisedTile{});
}

}  // namespace
}  // namespace lifeline::sharing
