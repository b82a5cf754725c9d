#include "coordinator/foxglove/protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/ros2/messages.hpp"
#include "coordinator/foxglove/foxglove_server.hpp"
#include "coordinator/foxglove/schemas.hpp"

namespace lifeline::foxglove {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Foxglove, EitherNameOfTheProtocolIsSpoken) {
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("chat, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1,foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.sdk.v2"), "");
  EXPECT_EQ(choose_subprotocol(""), "");
  EXPECT_EQ(choose_subprotocol(",,"), "");
}

TEST(Foxglove, AMessageBeginsWithItsKindSubscriptionAndTime) {
  EXPECT_THAT(message_data(0x0102, Timestamp(Duration(0x03)), {9}),
              ElementsAre(1, 2, 1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 9));
}

TEST(Foxglove, EveryTypeOfOursIsAdvertisedWithADefinition) {
  for (const auto type : {ros2::kOccupancyGrid, ros2::kPath, ros2::kTfMessage, ros2::kPoseStamped,
                          ros2::kLaserScan}) {
    EXPECT_THAT(schema_of(type), HasSubstr("MSG: std_msgs/Header\n")) << type;
  }
  const auto json = nlohmann::json::parse(advertise({{7, "/tf", std::string(ros2::kTfMessage)}}));
  EXPECT_EQ(json.at("op"), "advertise");
  const auto& channel = json.at("channels").at(0);
  EXPECT_EQ(channel.at("id"), 7);
  EXPECT_EQ(channel.at("encoding"), "cdr");
  EXPECT_EQ(channel.at("schemaEncoding"), "ros2msg");
}

TEST(Foxglove, WhatAClientAsksForIsReadAndNothingElse) {
  const auto asked = read_request(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":4}]})");
  ASSERT_TRUE(asked);
  ASSERT_EQ(asked->subscribe.size(), 2U);
  EXPECT_EQ(asked->subscribe[1].id, 4294967295U);
  EXPECT_EQ(asked->subscribe[1].channel, 4U);
  EXPECT_THAT(read_request(R"({"op":"unsubscribe","subscriptionIds":[1,2]})")->unsubscribe,
              ElementsAre(1, 2));
  EXPECT_TRUE(read_request(R"({"op":"getParameters"})"));
  for (const char* text :
       {"", "{", "[]", "3", R"({"op":1})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[3]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"unsubscribe","subscriptionIds":["1"]})"}) {
    EXPECT_FALSE(read_request(text)) << text;
  }
}

TEST(Foxglove, ATakenPortAndAnAddressThatIsNoneAreRefusedInOneLine) {
  const auto first = FoxgloveServer::start({"a", "127.0.0.1", 0, {}});
  ASSERT_TRUE(first) << first.error().text;
  const auto second = FoxgloveServer::start({"b", "127.0.0.1", (*first)->port(), {}});
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().text, HasSubstr("choose another foxglove.port"));
  const auto third = FoxgloveServer::start({"c", "vehicle", 0, {}});
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::wrong_use);
}

}  // namespace
}  // namespace lifeline::foxglove
