#include "coordinator/dashboard/order.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/dashboard.pb.h"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::dashboard {
namespace {

namespace pb = proto::dashboard;
using ::testing::ElementsAre;

Result<ClientRequest> decode(const std::function<void(pb::ClientFrame&)>& fill) {
  pb::ClientFrame frame;
  frame.set_request_id(9);
  fill(frame);
  const std::string bytes = frame.SerializeAsString();
  return decode_client_frame(
      std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

TEST(ClientFrames, GiveWhatThePageAsked) {
  const auto merge = decode([](pb::ClientFrame& frame) {
    frame.mutable_rule_merge()->set_map_a("alpha/1");
    frame.mutable_rule_merge()->set_map_b("bravo/2@-1");
    frame.mutable_rule_merge()->set_is_merged(true);
  });
  ASSERT_TRUE(merge) << merge.error().text;
  EXPECT_EQ(merge->request_id, 9U);
  const auto& rule = std::get<RuleMerge>(merge->content);
  EXPECT_EQ(rule.pair, (merging::LayerPair{test::layer("alpha"), test::layer("bravo", 2, -1)}));
  EXPECT_TRUE(rule.is_merged);

  const auto watch = decode([](pb::ClientFrame& frame) {
    for (const char* map : {"", "alpha/1", ""}) frame.mutable_watch()->add_maps(map);
  });
  EXPECT_THAT(std::get<Watch>(watch->content).maps, ElementsAre("", "alpha/1"));

  const auto steer = decode([](pb::ClientFrame& frame) {
    frame.mutable_steer()->set_is_paused(true);
    frame.mutable_steer()->set_speed(4.0);
    frame.mutable_steer()->set_to_s(12.5);
  });
  const auto& wish = std::get<Steer>(steer->content);
  EXPECT_TRUE(wish.is_paused);
  EXPECT_EQ(wish.speed, 4.0);
  EXPECT_EQ(wish.to, from_seconds(12.5));
  const auto live = decode([](pb::ClientFrame& frame) { frame.mutable_go_live(); });
  EXPECT_TRUE(std::holds_alternative<GoLive>(live->content));

  const auto alert = decode([](pb::ClientFrame& frame) {
    frame.mutable_raise_alert()->set_kind(pb::ROLL_CALL);
    frame.mutable_raise_alert()->set_text("Sammelpunkt Süd");
  });
  EXPECT_EQ(std::get<RaiseAlert>(alert->content).kind, wire::AlertKind::roll_call);
}

TEST(ClientFrames, ThatNobodyMayAskForAreRefused) {
  const std::vector<std::function<void(pb::ClientFrame&)>> wrong{
      [](pb::ClientFrame&) {},
      [](pb::ClientFrame& f) { f.mutable_steer()->set_speed(-1.0); },
      [](pb::ClientFrame& f) { f.mutable_steer()->set_speed(std::nan("")); },
      [](pb::ClientFrame& f) { f.mutable_steer()->set_speed(1e6); },
      [](pb::ClientFrame& f) { f.mutable_steer()->set_to_s(-0.1); },
      [](pb::ClientFrame& f) { f.mutable_steer()->set_to_s(std::nan("")); },
      [](pb::ClientFrame& f) { f.mutable_steer()->set_to_s(1e300); },
      [](pb::ClientFrame& f) { f.mutable_raise_alert()->set_kind(pb::MAYDAY); },
      [](pb::ClientFrame& f) {
        f.mutable_raise_alert()->set_kind(pb::EVACUATE);
        f.mutable_raise_alert()->set_text("a\nb");
      },
      [](pb::ClientFrame& f) {
        f.mutable_raise_alert()->set_kind(pb::EVACUATE);
        f.mutable_raise_alert()->set_subject_id("<script>");
      },
      [](pb::ClientFrame& f) {
        f.mutable_raise_alert()->set_kind(pb::EVACUATE);
        f.mutable_raise_alert()->set_text(std::string(129, 'x'));
      },
      [](pb::ClientFrame& f) {
        f.mutable_rule_find()->set_agent_id("alpha");
        f.mutable_rule_find()->set_state(pb::RESCUED);
      },
      [](pb::ClientFrame& f) { f.mutable_rule_find()->set_agent_id("../etc"); },
      [](pb::ClientFrame& f) {
        f.mutable_answer_alert()->set_issuer_id("alpha");
        f.mutable_answer_alert()->set_state(pb::RAISED);
      },
      [](pb::ClientFrame& f) {
        f.mutable_rule_merge()->set_map_a("bravo/1");
        f.mutable_rule_merge()->set_map_b("alpha/1");
      },
      [](pb::ClientFrame& f) { f.mutable_watch()->add_maps("alpha"); },
      [](pb::ClientFrame& f) {
        for (int i = 0; i < 5; ++i) f.mutable_watch()->add_maps("a/" + std::to_string(i));
      },
  };
  for (std::size_t i = 0; i < wrong.size(); ++i) EXPECT_FALSE(decode(wrong[i])) << i;
  const std::vector<std::uint8_t> noise(100, 0xff), huge(kMaxClientFrame + 1, 0);
  EXPECT_FALSE(decode_client_frame(noise));
  EXPECT_FALSE(decode_client_frame(huge));
}

TEST(MapNames, ComeBackAsTheyWereWritten) {
  for (const auto& key : {test::layer("alpha"), test::layer("b.c_d-e", 4294967295U, -100)})
    EXPECT_EQ(parse_map_name(to_string(key)).value(), key);
  for (const char* name : {"", "alpha", "alpha/", "alpha/x", "alpha/1@", "alpha/1@x", "alpha/01",
                           "alpha/1@0", "alpha/1@99999", "al pha/1", "a@1/1", "/1", "alpha/1/2"})
    EXPECT_FALSE(parse_map_name(name)) << name;
}

}  // namespace
}  // namespace lifeline::dashboard
