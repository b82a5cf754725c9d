// The directive told from helmet to helmet, where its coordinator cannot be heard.
#include "agents/sharing/directive_relay.hpp"

#include <algorithm>

#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::seconds;

constexpr Duration kLongEnough = seconds(12);

wire::AgentStatus status(const std::string& id, std::uint64_t epoch,
                         std::vector<std::string> hears) {
  wire::AgentStatus status;
  status.envelope = test::envelope(id);
  status.agent_id = id;
  status.epoch_applied = epoch;
  status.peers_heard = std::move(hears);
  return status;
}

wire::AgentStatus coordinator_status(wire::AgentState state) {
  wire::AgentStatus of = status("coordinator", 3, {});
  of.role = wire::Role::coordinator;
  of.state = state;
  return of;
}

/// `incarnation`: of the coordinator that wrote it.
wire::MergeDirective directive(std::uint64_t epoch, std::uint64_t incarnation = 5) {
  wire::MergeDirective directive;
  directive.envelope = test::envelope("coordinator", epoch);
  directive.envelope.incarnation = incarnation;
  directive.mission_id = test::kMission;
  directive.epoch = epoch;
  return directive;
}

wire::DirectiveCopy copy(const std::string& teller, std::uint64_t epoch,
                         std::uint64_t incarnation = 5) {
  wire::DirectiveCopy copy;
  copy.envelope = test::envelope(teller);
  copy.teller_id = teller;
  copy.directive = directive(epoch, incarnation);
  return copy;
}

class DirectiveRelayTest : public testing::Test {
 protected:
  void hear(const wire::AgentStatus& status) { EXPECT_TRUE(roster_.hear(status, at(0))); }
  static SteadyTime at(int ms) { return SteadyTime{} + seconds(100) + milliseconds(ms); }
  [[nodiscard]] bool is_due(int ms) { return relay_.is_due(at(ms), roster_, {own_, said_}); }
  [[nodiscard]] Result<bool> may_follow(const wire::DirectiveCopy& copy) {
    return relay_.may_follow(copy, at(0), roster_, own_);
  }
  /// Bravo and charlie hold the same tiles, and stand in these groups of the own directive.
  void hold_the_same(std::uint16_t bravos_group, std::uint16_t charlies_group) {
    said_ = status("bravo", 3, {});
    said_.map_id = 1;
    said_.layers = {{{"bravo", 1, 0}, 4, {7}}, {{"charlie", 1, 0}, 2, {8}}};
    said_.common_map_sha256 = {1};
    own_.members.resize(2);
    own_.members[0].layer = {"bravo", 1, 0};
    own_.members[0].group = bravos_group;
    own_.members[1].layer = {"charlie", 1, 0};
    own_.members[1].group = charlies_group;
    charlie_ = said_;
    charlie_.envelope = test::envelope("charlie");
    charlie_.agent_id = "charlie";
    charlie_.peers_heard = {"bravo"};
  }
  /// Whether charlie is told, once it was heard for long enough.
  [[nodiscard]] bool tells_charlie() {
    hear(charlie_);
    EXPECT_FALSE(is_due(0));
    return is_due(2000);
  }

  wire::MergeDirective own_ = directive(3);
  wire::AgentStatus said_, charlie_;
  Roster roster_;
  DirectiveRelay relay_{AgentId::parse("bravo").value()};
};

TEST_F(DirectiveRelayTest, TellsOneThatIsBehindAfterAWhileAndAgainLater) {
  hear(status("charlie", 2, {"bravo"}));
  EXPECT_FALSE(is_due(0));
  EXPECT_FALSE(is_due(1900));
  EXPECT_TRUE(is_due(2000));
  EXPECT_FALSE(is_due(2100));
}

TEST_F(DirectiveRelayTest, LeavesItToThoseWhoComeBeforeForAsLongAsTheyTake) {
  hear(status("alpha", 3, {}));
  hear(status("charlie", 2, {"alpha", "bravo"}));
  EXPECT_FALSE(is_due(0));
  EXPECT_FALSE(is_due(3900));
  EXPECT_TRUE(is_due(4000));
}

TEST_F(DirectiveRelayTest, DoesNotWaitForOneWhomTheOtherDoesNotHear) {
  hear(status("alpha", 3, {}));
  hear(status("charlie", 2, {"bravo"}));
  EXPECT_FALSE(is_due(0));
  EXPECT_TRUE(is_due(2000));
}

TEST_F(DirectiveRelayTest, TellsNobodyWhoHearsALeadingCoordinatorOrFollowsIt) {
  hear(coordinator_status(wire::AgentState::tracking));
  hear(status("charlie", 2, {"bravo", "coordinator"}));
  hear(status("delta", 3, {"bravo"}));
  EXPECT_FALSE(is_due(0));
  EXPECT_FALSE(is_due(4000));
}

TEST_F(DirectiveRelayTest, TellsWhereTheCoordinatorOnlyListens) {
  hear(coordinator_status(wire::AgentState::starting));
  hear(status("charlie", 2, {"bravo", "coordinator"}));
  EXPECT_FALSE(is_due(0));
  EXPECT_TRUE(is_due(2000));
}

TEST_F(DirectiveRelayTest, ANewerEpochIsFollowedAndNoOtherOne) {
  EXPECT_TRUE(may_follow(copy("alpha", 4)).value());
  EXPECT_FALSE(may_follow(copy("alpha", 3)).value());
  EXPECT_FALSE(may_follow(copy("alpha", 2)).value());
}

TEST_F(DirectiveRelayTest, OfTwoCoordinatorsDirectivesOfOneEpochAllFollowTheSame) {
  EXPECT_TRUE(may_follow(copy("alpha", 3, 9)).value());
  EXPECT_FALSE(is_due(0));
  EXPECT_FALSE(may_follow(copy("alpha", 3, 4)).value());
  EXPECT_TRUE(is_due(100)) << "who follows the other one is told";
  EXPECT_FALSE(is_due(200));
}

TEST_F(DirectiveRelayTest, OneThatMakesAnotherMapOfTheSameTilesIsTold) {
  hold_the_same(0, 0);
  charlie_.common_map_sha256 = {2};
  EXPECT_TRUE(tells_charlie());
}

TEST_F(DirectiveRelayTest, OneWithTheSameMapIsNotTold) {
  hold_the_same(0, 0);
  EXPECT_FALSE(tells_charlie());
}

TEST_F(DirectiveRelayTest, OneThatStillLacksTilesIsNotTold) {
  hold_the_same(0, 0);
  charlie_.common_map_sha256 = {2};
  charlie_.layers[0].revisions = {6};
  EXPECT_FALSE(tells_charlie());
}

TEST_F(DirectiveRelayTest, OneOfAnotherGroupHasAnotherMapRightly) {
  hold_the_same(0, 1);
  charlie_.common_map_sha256 = {2};
  EXPECT_FALSE(tells_charlie());
}

TEST_F(DirectiveRelayTest, WhoHearsTheCoordinatorFollowsItAlone) {
  hear(coordinator_status(wire::AgentState::tracking));
  EXPECT_FALSE(may_follow(copy("alpha", 4)).value());
}

TEST_F(DirectiveRelayTest, AnEpochBeyondAllCoordinatorsIsRefused) {
  EXPECT_FALSE(may_follow(copy("alpha", 2'000'000)));
}

TEST_F(DirectiveRelayTest, AnotherMissionsOrAnothersWordIsRefused) {
  auto foreign = copy("alpha", 4);
  foreign.directive.envelope.mission_id = "another";
  EXPECT_FALSE(may_follow(foreign));
  auto of_another = copy("alpha", 4);
  of_another.teller_id = "charlie";
  EXPECT_FALSE(may_follow(of_another));
}

TEST_F(HelmetSharingTest, ALateHelmetHearsTheDirectiveOfACoordinatorThatIsGone) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  alpha->put(random_tiles({{0, 0}, {4, 2}}));
  direct(3, {{"alpha", {}}, {"bravo", {1.0, 0.0, 0.1}}, {"charlie", {0.0, 2.0, 0.3}}});
  run({alpha.get(), bravo.get()});
  coordinator_.reset();
  auto told = bus_.reader<wire::DirectiveCopy>();
  auto charlie = make_helmet("charlie");
  run({alpha.get(), bravo.get(), charlie.get()}, kLongEnough);
  EXPECT_EQ(charlie->map().epoch(), Epoch{3});
  EXPECT_EQ(to_hex(alpha->map().common_map_sha256()), to_hex(charlie->map().common_map_sha256()));
  const auto copies = told->take();
  ASSERT_FALSE(copies.empty());
  EXPECT_TRUE(std::ranges::all_of(copies, [](const auto& c) { return c.teller_id == "alpha"; }));
  EXPECT_EQ(copies.front().directive.envelope.sender_id, "coordinator");
}

TEST_F(HelmetSharingTest, ADirectiveThatIsToldButNotSoundIsRefusedAndCounted) {
  auto alpha = make_helmet("alpha");
  auto hostile = bus_.writer<wire::DirectiveCopy>();
  auto told = copy("mallory", 1);
  told.directive.members.assign(2, {{"alpha", 1, 0}, 0, {}, {}, 1.0F});
  ASSERT_TRUE(hostile->put(told));
  run({alpha.get()});
  EXPECT_EQ(alpha->map().epoch(), Epoch{0});
  EXPECT_EQ(alpha->refused(), 1U);
}

}  // namespace
}  // namespace lifeline::sharing
