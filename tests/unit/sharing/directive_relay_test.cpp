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

wire::DirectiveCopy copy(const std::string& teller, std::uint64_t epoch) {
  wire::DirectiveCopy copy;
  copy.envelope = test::envelope(teller);
  copy.teller_id = teller;
  copy.directive.envelope = test::envelope("coordinator", epoch);
  copy.directive.mission_id = test::kMission;
  copy.directive.epoch = epoch;
  return copy;
}

class DirectiveRelayTest : public testing::Test {
 protected:
  void hear(const wire::AgentStatus& status) { EXPECT_TRUE(roster_.hear(status, at(0))); }
  static SteadyTime at(int ms) { return SteadyTime{} + seconds(100) + milliseconds(ms); }
  [[nodiscard]] bool is_due(int ms) { return relay_.is_due(at(ms), roster_, Epoch{3}); }
  [[nodiscard]] Result<bool> may_follow(const wire::DirectiveCopy& copy, std::uint64_t own) const {
    return relay_.may_follow(copy, at(0), roster_, Epoch{own});
  }

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
  EXPECT_TRUE(may_follow(copy("alpha", 4), 3).value());
  EXPECT_FALSE(may_follow(copy("alpha", 3), 3).value());
  EXPECT_FALSE(may_follow(copy("alpha", 2), 3).value());
}

TEST_F(DirectiveRelayTest, WhoHearsTheCoordinatorFollowsItAlone) {
  hear(coordinator_status(wire::AgentState::tracking));
  EXPECT_FALSE(may_follow(copy("alpha", 4), 3).value());
}

TEST_F(DirectiveRelayTest, AnEpochBeyondAllCoordinatorsIsRefused) {
  EXPECT_FALSE(may_follow(copy("alpha", 2'000'000), 3));
}

TEST_F(DirectiveRelayTest, AnotherMissionsOrAnothersWordIsRefused) {
  auto foreign = copy("alpha", 4);
  foreign.directive.envelope.mission_id = "another";
  EXPECT_FALSE(may_follow(foreign, 3));
  auto of_another = copy("alpha", 4);
  of_another.teller_id = "charlie";
  EXPECT_FALSE(may_follow(of_another, 3));
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
