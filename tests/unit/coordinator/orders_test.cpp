// What the commander decides, as everybody else hears it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"
#include "tests/support/fleet_channels.hpp"

namespace lifeline::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

CoordinatorChannels commander_channels(wire::LoopbackBus& bus) {
  auto channels = coordinator_channels(bus);
  channels.alerts = bus.reader<wire::Alert>();
  channels.alert = bus.writer<wire::Alert>();
  channels.ruling = bus.writer<wire::Detection>();
  return channels;
}

class CommanderOrders : public testing::Test {
 protected:
  void step() {
    clock_.advance(std::chrono::milliseconds(100));
    coordinator_.step();
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  wire::Alert mayday() {
    wire::Alert alert;
    alert.envelope = envelope("alpha");
    alert.issuer_id = "alpha";
    alert.alert_id = 3;
    alert.text = "no air";
    return alert;
  }

  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  Coordinator coordinator_{
      {{AgentId::parse("vehicle").value(), kMission, Incarnation{3}}, {}, {}, {}},
      commander_channels(bus_),
      worker_,
      clock_};
  std::unique_ptr<wire::Outbox<wire::Alert>> helmet_ = bus_.writer<wire::Alert>();
  std::unique_ptr<wire::Inbox<wire::Alert>> heard_ = bus_.reader<wire::Alert>();
  std::unique_ptr<wire::Outbox<wire::Detection>> finder_ = bus_.writer<wire::Detection>();
  std::unique_ptr<wire::Inbox<wire::Detection>> rulings_ = bus_.reader<wire::Detection>();
};

TEST_F(CommanderOrders, AMaydayIsAnsweredUntilItsIssuerSaysSo) {
  ASSERT_TRUE(helmet_->put(mayday()));
  step();
  ASSERT_NE(coordinator_.alerts().find({"alpha", 3}), nullptr);
  (void)heard_->take();
  ASSERT_TRUE(coordinator_.answer({"alpha", 3}, wire::AlertState::acknowledged));
  EXPECT_THAT(heard_->take().at(0).acknowledged_by, ElementsAre("vehicle"));
  run(15);
  EXPECT_FALSE(heard_->take().empty()) << "alpha may have missed it";
  auto known = mayday();
  known.envelope.sequence = 2;
  known.state = wire::AlertState::acknowledged;
  known.acknowledged_by = {"vehicle"};
  ASSERT_TRUE(helmet_->put(known));
  step();
  (void)heard_->take();
  run(30);
  EXPECT_TRUE(heard_->take().empty()) << "alpha knows";
}

TEST_F(CommanderOrders, ARollCallGathersWhoAnswered) {
  ASSERT_TRUE(coordinator_.raise(wire::AlertKind::roll_call, "", "count"));
  const auto call = heard_->take().at(0);
  EXPECT_EQ(call.issuer_id, "vehicle");
  for (const char* name : {"alpha", "bravo"}) {
    auto answer = call;
    answer.envelope = envelope(name);
    answer.state = wire::AlertState::acknowledged;
    answer.acknowledged_by = {name};
    ASSERT_TRUE(helmet_->put(answer));
    run(2);
  }
  EXPECT_THAT(coordinator_.alerts().find({"vehicle", call.alert_id})->alert.acknowledged_by,
              ElementsAre("alpha", "bravo"));
  EXPECT_THAT(heard_->take().back().acknowledged_by, ElementsAre("alpha", "bravo"))
      << "everybody is told";
}

TEST_F(CommanderOrders, TwoAlertsOfOneSecondAreTwo) {
  ASSERT_TRUE(coordinator_.raise(wire::AlertKind::evacuate, "", ""));
  ASSERT_TRUE(coordinator_.raise(wire::AlertKind::evacuate, "", ""));
  EXPECT_EQ(coordinator_.alerts().entries().size(), 2U);
}

TEST_F(CommanderOrders, AnAlertThatIsNotThereCannotBeAnswered) {
  const auto done = coordinator_.answer({"alpha", 3}, wire::AlertState::acknowledged);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().text, HasSubstr("no alert alpha/3"));
}

TEST_F(CommanderOrders, AHostileAlertIsRefusedAndCounted) {
  auto bad = mayday();
  bad.subject_id = "<b>";
  ASSERT_TRUE(helmet_->put(bad));
  step();
  EXPECT_TRUE(coordinator_.alerts().entries().empty());
  EXPECT_EQ(coordinator_.status().samples_refused, 1U);
}

TEST_F(CommanderOrders, AFindIsRuledOnForEverybodyAndAgainAfterItsHelmetSpoke) {
  auto seen = detection(layer("alpha"), 256, 1.0, 2.0);
  ASSERT_TRUE(finder_->put(seen));
  step();
  (void)rulings_->take();
  ASSERT_TRUE(coordinator_.rule({"alpha", 256}, wire::DetectionState::confirmed));
  EXPECT_EQ(coordinator_.detections().at(0).state, wire::DetectionState::confirmed);
  const auto ruling = rulings_->take().at(0);
  EXPECT_EQ(ruling.envelope.sender_id, "vehicle");
  EXPECT_EQ(ruling.agent_id, "alpha");
  seen.revision = 2;
  ASSERT_TRUE(finder_->put(seen));
  step();
  const auto after = rulings_->take();
  ASSERT_FALSE(after.empty());
  EXPECT_EQ(after.back().envelope.sender_id, "vehicle") << "the newest that a late reader gets";
  EXPECT_EQ(coordinator_.detections().at(0).state, wire::DetectionState::confirmed);
  ASSERT_TRUE(coordinator_.rule({"alpha", 256}, wire::DetectionState::reported));
  EXPECT_EQ(coordinator_.detections().at(0).state, wire::DetectionState::reported);
}

TEST_F(CommanderOrders, WhatWasNeverMatchedCannotBeMergedOrParted) {
  step();
  const merging::LayerPair pair{layer("alpha"), layer("bravo")};
  EXPECT_THAT(coordinator_.merge(pair).error().text, HasSubstr("no match found a place"));
  EXPECT_THAT(coordinator_.part(pair).error().text, HasSubstr("never matched"));
}

TEST_F(CommanderOrders, LostPosesAreCounted) {
  wire::HelmetPose pose;
  pose.agent_id = "alpha";
  pose.map_id = 1;
  const auto poses = bus_.writer<wire::HelmetPose>();
  for (std::uint64_t sequence = 1; sequence <= 100; ++sequence) {
    if (sequence % 4 == 0) continue;
    pose.envelope = envelope("alpha", sequence);
    ASSERT_TRUE(poses->put(pose));
    step();
  }
  EXPECT_NEAR(coordinator_.poses().find("alpha")->loss, 0.25, 0.02);
}

}  // namespace
}  // namespace lifeline::test
