// Maydays, evacuations and roll calls between helmets and a commander, each as the real state
// machines say and hear them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/alert_exchange.hpp"
#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::sharing {
namespace {

using testing::ElementsAre;
using wire::AlertKind;
using wire::AlertState;

class HelmetAlerts : public HelmetSharingTest {
 protected:
  /// The commander's roster is empty: what a coordinator may do, it may.
  void step_commander() { commander_.step({}, notes_); }
  void say_that_the_vehicle_commands() {
    wire::AgentStatus status;
    status.envelope = test::envelope("vehicle");
    status.agent_id = "vehicle";
    status.role = wire::Role::coordinator;
    ASSERT_TRUE(statuses_->put(status));
  }
  const wire::Alert* held_by(const HelmetSharing& helmet, const AlertKey& key) {
    const auto* entry = helmet.alerts().list().find(key);
    return entry == nullptr ? nullptr : &entry->alert;
  }

  HearingNotes notes_;
  AlertExchange commander_{speaker("vehicle", 9), wire::Role::coordinator,
                           bus_.reader<wire::Alert>(), bus_.writer<wire::Alert>(), clock_};
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> statuses_ = bus_.writer<wire::AgentStatus>();
  std::unique_ptr<wire::Outbox<wire::Alert>> stranger_ = bus_.writer<wire::Alert>();
  std::unique_ptr<wire::Inbox<wire::Alert>> heard_ = bus_.reader<wire::Alert>();
};

TEST_F(HelmetAlerts, AMaydayIsShownToMatesAndCommanderAndEndsWhereItBegan) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  ASSERT_TRUE(alpha->raise_mayday("no air"));
  run({alpha.get(), bravo.get()}, milliseconds(100));
  step_commander();
  const auto key = alpha->own_mayday();
  ASSERT_TRUE(key);
  ASSERT_NE(held_by(*bravo, *key), nullptr);
  EXPECT_EQ(held_by(*bravo, *key)->text, "no air");
  ASSERT_NE(commander_.list().find(*key), nullptr);
  ASSERT_TRUE(alpha->cancel_mayday());
  run({alpha.get(), bravo.get()}, milliseconds(100));
  step_commander();
  EXPECT_FALSE(alpha->own_mayday());
  EXPECT_EQ(held_by(*bravo, *key)->state, AlertState::cleared);
  EXPECT_EQ(commander_.list().find(*key)->alert.state, AlertState::cleared);
}

TEST_F(HelmetAlerts, AMaydayPressedTwiceIsOneAndTheNextOneIsAnother) {
  auto alpha = make_helmet("alpha");
  ASSERT_TRUE(alpha->raise_mayday(""));
  ASSERT_TRUE(alpha->raise_mayday(""));
  EXPECT_EQ(alpha->alerts().own().size(), 1U);
  const auto first = alpha->own_mayday();
  ASSERT_TRUE(alpha->cancel_mayday());
  EXPECT_FALSE(alpha->cancel_mayday());
  ASSERT_TRUE(alpha->raise_mayday(""));
  EXPECT_NE(alpha->own_mayday(), first);
}

TEST_F(HelmetAlerts, AHelmetsAnswerLeavesTheMaydayToTheCommander) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  ASSERT_TRUE(alpha->raise_mayday(""));
  run({alpha.get(), bravo.get()}, milliseconds(100));
  const AlertKey key = alpha->own_mayday().value();
  ASSERT_TRUE(bravo->answer(key));
  run({alpha.get(), bravo.get()}, milliseconds(2000));
  EXPECT_THAT(held_by(*alpha, key)->acknowledged_by, ElementsAre("bravo"));
  EXPECT_EQ(held_by(*alpha, key)->state, AlertState::raised) << "nobody in command has seen it";
  step_commander();
  ASSERT_TRUE(commander_.answer(key, AlertState::acknowledged));
  run({alpha.get()}, milliseconds(100));
  EXPECT_THAT(held_by(*alpha, key)->acknowledged_by, ElementsAre("bravo", "vehicle"));
  EXPECT_EQ(held_by(*alpha, key)->state, AlertState::acknowledged);
}

TEST_F(HelmetAlerts, ARollCallIsAnsweredByAllAndStopsBeingRepeated) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  const AlertKey call = commander_.raise(AlertKind::roll_call, "", "PAR?").value();
  run({alpha.get(), bravo.get()}, milliseconds(100));
  ASSERT_TRUE(alpha->answer(call));
  ASSERT_TRUE(bravo->answer(call));
  for (int i = 0; i < 60; ++i) {
    run({alpha.get(), bravo.get()}, milliseconds(100));
    step_commander();
  }
  EXPECT_THAT(commander_.list().find(call)->alert.acknowledged_by, ElementsAre("alpha", "bravo"));
  EXPECT_TRUE(alpha->alerts().list().find(call)->is_gathered);
  (void)heard_->take();
  run({alpha.get(), bravo.get()}, milliseconds(4000));
  EXPECT_TRUE(heard_->take().empty()) << "the commander is not there to miss it";
}

TEST_F(HelmetAlerts, WhoOnlyThenHearsOfTheCommandDoesNotLetHelmetsEndItsOrders) {
  auto alpha = make_helmet("alpha");
  const AlertKey order = commander_.raise(AlertKind::evacuate, "", "").value();
  run({alpha.get()}, milliseconds(100));
  wire::Alert forged = *held_by(*alpha, order);
  forged.envelope = test::envelope("mallory");
  forged.state = AlertState::cleared;
  ASSERT_TRUE(stranger_->put(forged));
  run({alpha.get()}, milliseconds(100));
  EXPECT_NE(held_by(*alpha, order)->state, AlertState::cleared);
}

TEST_F(HelmetAlerts, TheCommanderEndsAMaydayOfAHelmet) {
  auto alpha = make_helmet("alpha");
  ASSERT_TRUE(alpha->raise_mayday(""));
  say_that_the_vehicle_commands();
  step_commander();
  ASSERT_TRUE(commander_.answer(alpha->own_mayday().value(), AlertState::cleared));
  run({alpha.get()}, milliseconds(100));
  EXPECT_FALSE(alpha->own_mayday());
}

TEST_F(HelmetAlerts, AHelmetThatComesLaterHearsOfAnOpenMayday) {
  auto alpha = make_helmet("alpha");
  ASSERT_TRUE(alpha->raise_mayday("trapped"));
  run({alpha.get()});
  auto bravo = make_helmet("bravo");
  run({bravo.get()}, milliseconds(100));
  ASSERT_NE(held_by(*bravo, alpha->own_mayday().value()), nullptr);
}

TEST_F(HelmetAlerts, AHelmetThatWasRestartedGoesOnWithItsMaydayAndCanCancelIt) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  ASSERT_TRUE(alpha->raise_mayday("no air"));
  const AlertKey key = alpha->own_mayday().value();
  SharingMemory memory;
  memory.alerts = alpha->alerts().own();
  alpha.reset();
  alpha = make_helmet("alpha", 2);
  ASSERT_TRUE(alpha->resume(memory));
  run({alpha.get(), bravo.get()}, milliseconds(100));
  EXPECT_EQ(alpha->own_mayday(), key);
  EXPECT_EQ(held_by(*bravo, key)->text, "no air");
  ASSERT_TRUE(alpha->cancel_mayday());
  run({alpha.get(), bravo.get()}, milliseconds(100));
  EXPECT_EQ(held_by(*bravo, key)->state, AlertState::cleared);
}

TEST_F(HelmetAlerts, AMemoryOfSomebodyElsesMaydayIsRefused) {
  auto alpha = make_helmet("alpha");
  SharingMemory memory;
  memory.alerts.resize(1);
  memory.alerts[0].issuer_id = "bravo";
  EXPECT_FALSE(alpha->resume(memory));
  EXPECT_FALSE(alpha->own_mayday());
}

TEST_F(HelmetAlerts, HostileAlertsAreRefusedAndCounted) {
  auto alpha = make_helmet("alpha");
  wire::Alert bad;
  bad.envelope = test::envelope("mallory");
  bad.issuer_id = "mallory";
  bad.alert_id = 1;
  auto too_long = bad, no_kind = bad, other_mission = bad, no_name = bad;
  too_long.text.assign(200, 'x');
  no_kind.alert_id = 2;
  no_kind.kind = static_cast<AlertKind>(200);
  other_mission.alert_id = 3;
  other_mission.envelope.mission_id = "other";
  no_name.alert_id = 4;
  no_name.subject_id = "<b>";
  for (const auto& sample : {too_long, no_kind, other_mission, no_name})
    ASSERT_TRUE(stranger_->put(sample));
  run({alpha.get()}, milliseconds(100));
  EXPECT_TRUE(alpha->alerts().list().entries().empty());
  EXPECT_EQ(alpha->status().samples_refused, 4U);
}

TEST_F(HelmetAlerts, MatesAreHeardToBeSomewhereAndHostilePosesAreRefused) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  HelmetState state;
  state.state = wire::AgentState::tracking;
  state.T_map_head = {3.0, 4.0, 0.5};
  state.trust_percent = 90;
  bravo->put(state);
  run({alpha.get(), bravo.get()}, milliseconds(500));
  ASSERT_NE(alpha->poses().find("bravo"), nullptr);
  EXPECT_DOUBLE_EQ(alpha->poses().find("bravo")->pose.T_map_head.x_m, 3.0);
  const auto poses = bus_.writer<wire::HelmetPose>();
  wire::HelmetPose forged = alpha->poses().find("bravo")->pose;
  forged.envelope = test::envelope("mallory");
  ASSERT_TRUE(poses->put(forged));
  run({alpha.get()}, milliseconds(50));
  forged.agent_id = "mallory";
  forged.T_map_head.x_m = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(poses->put(forged));
  run({alpha.get()}, milliseconds(50));
  EXPECT_EQ(alpha->poses().find("mallory"), nullptr);
  EXPECT_EQ(alpha->status().samples_refused, 2U);
}

}  // namespace
}  // namespace lifeline::sharing
