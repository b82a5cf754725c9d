// Who asks whom for what, and what is sent.
#include "common/sharing/tile_exchange.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/accept.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::milliseconds;
using test::layer;
using testing::IsEmpty;
using testing::SizeIs;

class TileAskerTest : public testing::Test {
 protected:
  void hold(const LayerKey& key, TileIndex tile, std::uint64_t revision) {
    ASSERT_TRUE(test::apply(store_, test::tile_samples(key, tile, revision, cells_)));
  }
  // What a participant says that it holds; its store is made for that.
  void say(const std::string& id, const LayerKey& key, std::uint64_t revision,
           wire::Role role = wire::Role::helmet, std::uint32_t map = 1, std::uint32_t tiles = 1) {
    ReplicaStore theirs{GridGeometry{}};
    ASSERT_TRUE(test::apply(theirs, test::tile_samples(key, {0, 0}, revision, cells_)));
    wire::AgentStatus status;
    status.envelope = test::envelope(id, ++sequence_);
    status.agent_id = id;
    status.role = role;
    status.map_id = map;
    status.layers = {{to_layer_name(key), tiles, theirs.digest(key)}};
    ASSERT_TRUE(roster_.hear(status, now_));
  }
  // All requests within so much time.
  std::vector<wire::TileRequest> run(Duration time) {
    std::vector<wire::TileRequest> requests;
    for (Duration passed{}; passed < time; passed += milliseconds(50)) {
      now_ += milliseconds(50);
      if (auto request = asker_.step(now_, roster_, store_)) requests.push_back(*request);
    }
    return requests;
  }

  std::mt19937 random_{4};
  QuantisedTile cells_ = test::small_tile(random_);
  SteadyTime now_{std::chrono::hours(1)};
  std::uint64_t sequence_ = 0;
  Roster roster_;
  ReplicaStore store_{GridGeometry{}};
  TileAsker asker_{AgentId::parse("alpha").value(), layer("alpha")};
};

TEST_F(TileAskerTest, AsksForNothingWhileAllHoldTheSame) {
  hold(layer("bravo"), {0, 0}, 3);
  say("bravo", layer("bravo"), 3);
  EXPECT_THAT(run(milliseconds(4000)), IsEmpty());
}

TEST_F(TileAskerTest, WaitsForWhatIsOnItsWay) {
  say("bravo", layer("bravo"), 1);
  EXPECT_THAT(run(milliseconds(1400)), IsEmpty());
  EXPECT_EQ(asker_.layers_behind(now_), 0U);
  EXPECT_THAT(run(milliseconds(400)), SizeIs(1));
  EXPECT_EQ(asker_.layers_behind(now_), 1U);
}

TEST_F(TileAskerTest, WhoLacksManyTilesAsksSoon) {
  hold(layer("bravo"), {0, 0}, 1);
  say("bravo", layer("bravo"), 2, wire::Role::helmet, 1, 16);  // 15 more
  EXPECT_THAT(run(milliseconds(1400)), IsEmpty());
  say("bravo", layer("bravo"), 2, wire::Role::helmet, 1, 40);
  EXPECT_THAT(run(milliseconds(300)), SizeIs(1));
  // While its tiles come in, that is enough.
  for (int x = 1; x <= 5; ++x) {
    hold(layer("bravo"), {x, 0}, 1);
    EXPECT_THAT(run(milliseconds(400)), IsEmpty());
  }
  EXPECT_THAT(run(milliseconds(700)), SizeIs(1));
}

TEST_F(TileAskerTest, AsksTheOwnerWhileItIsHeard) {
  say("bravo", layer("bravo"), 2);
  say("coordinator", layer("bravo"), 1, wire::Role::coordinator);
  const auto requests = run(milliseconds(2000));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "bravo");
  EXPECT_EQ(requests[0].requester_id, "alpha");
}

TEST_F(TileAskerTest, BelievesTheOwnerAboveAll) {
  hold(layer("bravo"), {0, 0}, 2);
  say("bravo", layer("bravo"), 2);
  say("charlie", layer("bravo"), 1);  // behind, and will ask itself
  EXPECT_THAT(run(milliseconds(4000)), IsEmpty());
}

TEST_F(TileAskerTest, OfTheLostAsksTheCoordinatorAndThenOneAfterTheOther) {
  say("charlie", layer("bravo"), 1);
  say("coordinator", layer("bravo"), 2, wire::Role::coordinator);
  auto requests = run(milliseconds(2000));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "coordinator");
  requests = run(milliseconds(1500));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "charlie");
}

TEST_F(TileAskerTest, AsksWhoHoldsAsMuchAsTheOwnerWhereThatOneDoesNotAnswer) {
  say("bravo", layer("bravo"), 2);
  say("charlie", layer("bravo"), 1);  // behind, too
  say("delta", layer("bravo"), 2);
  auto requests = run(milliseconds(2000));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "bravo");
  requests = run(milliseconds(1500));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "delta");
}

TEST_F(TileAskerTest, DoesNotTakeAHelmetThatStartedAnewForTheOwnerOfItsFormerMap) {
  hold(layer("bravo"), {0, 0}, 1);
  say("bravo", layer("bravo"), 1, wire::Role::helmet, 2);
  say("charlie", layer("bravo"), 2);
  const auto requests = run(milliseconds(2000));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].asked_id, "charlie");
}

TEST_F(TileAskerTest, NeverAsksForItsOwnLayer) {
  say("bravo", layer("alpha"), 5);
  EXPECT_THAT(run(milliseconds(4000)), IsEmpty());
}

TEST_F(TileAskerTest, WaitsTwiceAsLongAfterEachRoundWithoutAGain) {
  std::vector<int> asked;
  for (int second = 0; second < 30; ++second) {
    say("bravo", layer("bravo"), 1);
    asked.push_back(static_cast<int>(run(milliseconds(1000)).size()));
  }
  // After 1.5, 2.5, 4.5, 8.5, 16.5 and 24.5 s.
  EXPECT_EQ(std::count(asked.begin(), asked.end(), 1), 6);
  EXPECT_EQ(std::count(asked.begin(), asked.end(), 0), 24);
}

TEST_F(TileAskerTest, WalksThroughALargeLayerInRequestsThatMeetEndToEnd) {
  for (std::int32_t x = 0; x < 10; ++x) {
    for (std::int32_t y = 0; y < 10; ++y) hold(layer("bravo"), {x, y}, 1);
  }
  say("bravo", layer("bravo"), 7);
  const auto requests = run(milliseconds(2000));
  ASSERT_THAT(requests, SizeIs(3));
  std::size_t listed = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    listed += requests[i].held.size();
    if (i == 0) continue;
    EXPECT_EQ(requests[i].after_x, requests[i - 1].to_x);
    EXPECT_EQ(requests[i].after_y, requests[i - 1].to_y);
  }
  EXPECT_EQ(listed, 100U);
}

class TileServerTest : public testing::Test, public wire::Outbox<wire::TileCopy> {
 protected:
  Result<void> put(const wire::TileCopy& copy) override {
    sent_.push_back(copy);
    return {};
  }
  bool has_reader() const override { return true; }

  TileServerTest() {
    for (std::int32_t x = 0; x < 3; ++x)
      EXPECT_TRUE(test::apply(store_, test::tile_samples(layer("bravo"), {x, 0}, 5, cells_)));
  }
  wire::TileRequest request(std::vector<wire::TileName> held) const {
    wire::TileRequest request;
    request.envelope = test::envelope("alpha");
    request.requester_id = "alpha";
    request.asked_id = "charlie";
    request.layer = to_layer_name(layer("bravo"));
    request.after_x = request.after_y = -1000;
    request.to_x = request.to_y = 1000;
    request.held = std::move(held);
    return request;
  }
  void step() {
    now_ += milliseconds(100);
    link_.measure(now_, [] { return Audience{1}; });
    ASSERT_TRUE(server_.step(now_, {}, store_, link_));
  }

  std::mt19937 random_{4};
  QuantisedTile cells_ = test::small_tile(random_);
  ReplicaStore store_{GridGeometry{}};
  std::vector<wire::TileCopy> sent_;
  SteadyTime now_{std::chrono::hours(1)};
  LinkBudget link_{1e9, [] { return std::uint64_t{0}; }};
  TileServer server_{
      {AgentId::parse("charlie").value(), test::kMission, Incarnation{1}}, {}, 1e9, *this};
};

TEST_F(TileServerTest, SendsWhatIsNewerOrNotListed) {
  ASSERT_TRUE(server_.take(request({{0, 0, 5}, {1, 0, 4}}), store_));
  EXPECT_EQ(server_.waiting(), 2U);
  step();
  ASSERT_THAT(sent_, SizeIs(2));
  EXPECT_EQ(sent_[0].tile_x, 1);
  EXPECT_EQ(sent_[1].tile_x, 2);
  EXPECT_EQ(sent_[0].envelope.sender_id, "charlie");
  EXPECT_EQ(sent_[0].layer.agent_id, "bravo");
  ReplicaStore theirs{GridGeometry{}};
  ASSERT_TRUE(theirs.apply(sent_[0]));
  EXPECT_EQ(*theirs.find(layer("bravo"))->at({1, 0}).cells, cells_);
}

TEST_F(TileServerTest, SendsOnceWhatIsAskedForTwice) {
  ASSERT_TRUE(server_.take(request({}), store_));
  ASSERT_TRUE(server_.take(request({}), store_));
  step();
  EXPECT_THAT(sent_, SizeIs(3));
}

TEST_F(TileServerTest, OfItsOwnLayerNotesWhatOthersHoldNewer) {
  TileServer owner({AgentId::parse("bravo").value(), test::kMission, Incarnation{1}},
                   layer("bravo"), 1e9, *this);
  auto listed = request({{0, 0, 5}, {1, 0, 6}, {2, 0, 4}, {7, 7, 1}});
  listed.asked_id = "bravo";
  ASSERT_TRUE(owner.take(listed, store_));
  const std::map<TileIndex, Revision> newer{{{1, 0}, Revision{6}}, {{7, 7}, Revision{1}}};
  EXPECT_EQ(owner.take_newer_elsewhere(), newer);
  EXPECT_TRUE(owner.take_newer_elsewhere().empty()) << "said once";
  ASSERT_TRUE(server_.take(request({{1, 0, 6}}), store_));
  EXPECT_TRUE(server_.take_newer_elsewhere().empty()) << "another's layer";
}

TEST_F(TileServerTest, LeavesRequestsToOthersAlone) {
  auto to_another = request({});
  to_another.asked_id = "delta";
  ASSERT_TRUE(server_.take(to_another, store_));
  EXPECT_EQ(server_.waiting(), 0U);
}

TEST_F(TileServerTest, RefusesAStretchThatEndsBeforeItBegins) {
  auto backwards = request({});
  std::swap(backwards.after_x, backwards.to_x);
  EXPECT_FALSE(server_.take(backwards, store_));
}

TEST_F(TileServerTest, KeepsToItsShare) {
  TileServer poor({AgentId::parse("charlie").value(), test::kMission, Incarnation{1}}, {}, 1.0,
                  *this);
  ASSERT_TRUE(poor.take(request({}), store_));
  for (int i = 0; i < 20; ++i) {
    now_ += milliseconds(100);
    link_.measure(now_, [] { return Audience{1}; });
    ASSERT_TRUE(poor.step(now_, {}, store_, link_));
  }
  EXPECT_THAT(sent_, SizeIs(1));  // a bucket may go into debt by one sample
  EXPECT_EQ(poor.waiting(), 2U);
}

}  // namespace
}  // namespace lifeline::sharing
