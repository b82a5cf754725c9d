// Two coordinators and a helmet's word: whoever leads is followed by all, whatever was missed.
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::test {
namespace {

using std::chrono::seconds;

/// Hears nothing while it is deaf: what arrives then is lost.
class DeafInbox : public wire::Inbox<wire::MergeDirective> {
 public:
  DeafInbox(std::unique_ptr<wire::Inbox<wire::MergeDirective>> inbox, const bool& deaf)
      : inbox_(std::move(inbox)), deaf_(deaf) {}
  std::vector<wire::MergeDirective> take() override {
    auto heard = inbox_->take();
    return deaf_ ? std::vector<wire::MergeDirective>{} : heard;
  }
  [[nodiscard]] std::uint64_t refused() const override { return 0; }

 private:
  std::unique_ptr<wire::Inbox<wire::MergeDirective>> inbox_;
  const bool& deaf_;
};

wire::MergeDirective directive_of_two(std::uint64_t epoch) {
  wire::MergeDirective directive;
  directive.envelope = envelope("before");
  directive.mission_id = kMission;
  directive.epoch = epoch;
  for (const char* name : {"alpha", "bravo"})
    directive.members.push_back({sharing::to_layer_name(layer(name)), 0, sharing::to_fixed({})});
  return directive;
}

class Following : public testing::Test {
 protected:
  std::unique_ptr<Coordinator> start(const std::string& id, bool standby) {
    auto channels = coordinator_channels(bus_);
    channels.directive.reset();
    channels.directives =
        std::make_unique<DeafInbox>(bus_.reader<wire::MergeDirective>(), directives_are_lost_);
    channels.open_directive = [this] {
      return Result<std::unique_ptr<wire::Outbox<wire::MergeDirective>>>(
          bus_.writer<wire::MergeDirective>());
    };
    CoordinatorSettings settings{
        {AgentId::parse(id).value(), kMission, Incarnation{3}}, {}, {}, {}};
    settings.leadership.standby = standby;
    return std::make_unique<Coordinator>(settings, std::move(channels), worker_, clock_);
  }
  std::unique_ptr<Coordinator> start_with_directive(const std::string& id) {
    auto coordinator = start(id, false);
    EXPECT_TRUE(coordinator->resume({{}, directive_of_two(4), {}}));
    return coordinator;
  }
  void pass(Duration time, std::initializer_list<Coordinator*> coordinators) {
    for (Duration passed{}; passed < time; passed += std::chrono::milliseconds(100)) {
      clock_.advance(std::chrono::milliseconds(100));
      for (Coordinator* one : coordinators) one->step();
    }
  }
  /// What alpha says of itself once a second while `leader` leads.
  void say(const wire::AgentStatus& status, Duration time, Coordinator& leader) {
    for (Duration passed{}; passed < time; passed += seconds(1)) {
      auto sample = status;
      sample.envelope = envelope("alpha", ++sequence_);
      ASSERT_TRUE(statuses_->put(sample));
      pass(seconds(1), {&leader});
    }
  }

  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  bool directives_are_lost_ = false;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> statuses_ = bus_.writer<wire::AgentStatus>();
  std::uint64_t sequence_ = 0;
};

TEST_F(Following, AStandbyThatGivesWayKnowsWhatWasSaidWhileItStillLed) {
  const auto standby = start("spare", true);
  pass(seconds(5), {standby.get()});
  ASSERT_TRUE(standby->leads());
  const auto primary = start_with_directive("vehicle");
  pass(seconds(5), {primary.get(), standby.get()});
  ASSERT_TRUE(primary->leads());
  ASSERT_FALSE(standby->leads());
  EXPECT_EQ(standby->directive().epoch, primary->directive().epoch);
  EXPECT_EQ(standby->directive().members.size(), 2U);
  EXPECT_EQ(standby->status().common_map_sha256, primary->status().common_map_sha256);
}

TEST_F(Following, AStandbyThatMissedTheDirectiveIsToldAgain) {
  directives_are_lost_ = true;
  const auto primary = start_with_directive("vehicle");
  const auto standby = start("spare", true);
  pass(seconds(4), {primary.get(), standby.get()});
  ASSERT_TRUE(primary->leads());
  ASSERT_EQ(standby->directive().epoch, 0U);
  directives_are_lost_ = false;
  pass(seconds(3), {primary.get(), standby.get()});
  EXPECT_EQ(standby->directive().epoch, primary->directive().epoch);
}

TEST_F(Following, AHelmetWithAnotherDirectiveOfOurEpochGetsOneThatOutranksBoth) {
  const auto leader = start_with_directive("vehicle");
  pass(seconds(5), {leader.get()});
  auto alpha = leader->status();  // the same tiles, epoch and map
  alpha.agent_id = "alpha";
  alpha.role = wire::Role::helmet;
  alpha.map_id = 1;
  const std::uint64_t epoch = alpha.epoch_applied;
  say(alpha, seconds(6), *leader);
  EXPECT_EQ(leader->directive().epoch, epoch) << "its map is ours";
  alpha.common_map_sha256.fill(1);
  say(alpha, seconds(2), *leader);
  EXPECT_EQ(leader->directive().epoch, epoch) << "it may be about to show its newest tiles";
  say(alpha, seconds(3), *leader);
  EXPECT_EQ(leader->directive().epoch, epoch + 1);
}

TEST_F(Following, AHelmetOfAnotherGroupMayHaveAnotherMap) {
  const auto leader = start_with_directive("vehicle");
  pass(seconds(5), {leader.get()});
  auto other = leader->status();
  other.agent_id = "alpha";
  other.role = wire::Role::helmet;
  other.map_id = 2;
  other.common_map_sha256.fill(1);
  const std::uint64_t epoch = other.epoch_applied;
  say(other, seconds(8), *leader);
  EXPECT_EQ(leader->directive().epoch, epoch);
}

}  // namespace
}  // namespace lifeline::test
