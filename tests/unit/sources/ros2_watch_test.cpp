#include "agents/sources/ros2_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/logged.hpp"

namespace lifeline::sources {
namespace {

using dds::RawTopicState;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

const dds::PublisherId kFirst{1}, kSecond{2};

class TopicWatchTest : public ::testing::Test {
 protected:
  SteadyTime at_ms(int ms) const { return start_ + milliseconds(ms); }
  /// A message of the first publisher that can be used.
  void hear(int ms) {
    EXPECT_TRUE(watch_.takes(kFirst, at_ms(ms)));
    watch_.note_good(at_ms(ms));
  }
  TopicFault fault_at(int ms, const RawTopicState& state) {
    watch_.look(state, at_ms(ms));
    return watch_.fault();
  }

  const SteadyTime start_{std::chrono::hours(1)};
  TopicWatch watch_{"/scan", "the::Type_", 5, start_};
  test::Logged logged_;
};

RawTopicState published() {
  return {.matched = 1, .announced = 1, .foreign_type = {}, .refused_policy = 0};
}

TEST_F(TopicWatchTest, ADriverHasTimeToBeFound) {
  EXPECT_EQ(fault_at(2999, {}), TopicFault::none);
  EXPECT_EQ(fault_at(3000, {}), TopicFault::unpublished);
  EXPECT_THAT(logged_.text(), HasSubstr("/scan: nobody publishes it (DDS: rt/scan) in domain 5;"));
}

TEST_F(TopicWatchTest, WhatIsWrongIsSaidOnceAndWhenItIsMended) {
  for (int ms = 3000; ms < 5000; ms += 100) (void)fault_at(ms, {});
  hear(5000);
  for (int ms = 5000; ms < 5900; ms += 100) EXPECT_EQ(fault_at(ms, published()), TopicFault::none);
  EXPECT_EQ(logged_.text(),
            "/scan: nobody publishes it (DDS: rt/scan) in domain 5; check that the driver runs, "
            "its ROS_DOMAIN_ID, and that the QoS file names its network\n"
            "/scan: has a publisher in domain 5\n/scan: is heard\n");
}

TEST_F(TopicWatchTest, AForeignTypeIsNamedWithoutItsControlCharacters) {
  EXPECT_EQ(fault_at(3000, {.matched = 0,
                            .announced = 0,
                            .foreign_type = "other::\x1b[31mType_",
                            .refused_policy = 0}),
            TopicFault::foreign_type);
  EXPECT_EQ(logged_.text(),
            "/scan: is published as other::?[31mType_, not as the::Type_; name the right topic\n");
}

TEST_F(TopicWatchTest, QosThatDoesNotFitIsNamed) {
  EXPECT_EQ(fault_at(3000, {.matched = 0, .announced = 1, .foreign_type = {}, .refused_policy = 6}),
            TopicFault::foreign_qos);
  EXPECT_THAT(logged_.text(), HasSubstr("QoS does not fit (DDS policy 6)"));
}

TEST_F(TopicWatchTest, SilenceIsSeenAfterASecond) {
  hear(100);
  EXPECT_EQ(fault_at(1099, published()), TopicFault::none);
  EXPECT_EQ(fault_at(1100, published()), TopicFault::silent);
  EXPECT_THAT(logged_.text(), HasSubstr("/scan: silent, though its publisher is there"));
  EXPECT_EQ(fault_at(1200, {}), TopicFault::unpublished);  // it left
}

TEST_F(TopicWatchTest, MessagesThatCannotBeUsedAreCountedAndTheFirstAndEveryThousandthNamed) {
  for (int i = 0; i < 2001; ++i) watch_.note_bad("reason", at_ms(i));
  EXPECT_EQ(watch_.bad(), 2001U);
  EXPECT_EQ(logged_.text(),
            "/scan: 1 of its messages cannot be used so far; the last: reason\n"
            "/scan: 1001 of its messages cannot be used so far; the last: reason\n"
            "/scan: 2001 of its messages cannot be used so far; the last: reason\n");
  EXPECT_EQ(fault_at(2001, published()), TopicFault::unusable);
}

TEST_F(TopicWatchTest, ASingleBadMessageAmongGoodOnesIsNoFault) {
  hear(100);
  watch_.note_bad("reason", at_ms(200));
  EXPECT_EQ(fault_at(300, published()), TopicFault::none);
}

TEST_F(TopicWatchTest, OfTwoPublishersOneIsTakenAndTheOtherNamedOnce) {
  for (int ms = 0; ms < 3000; ms += 100) {
    hear(ms);
    EXPECT_FALSE(watch_.takes(kSecond, at_ms(ms + 50)));
  }
  EXPECT_EQ(logged_.text(),
            "/scan: has several publishers in domain 5, only one is taken; give each helmet's "
            "driver a domain of its own\n");
}

TEST_F(TopicWatchTest, ADriverThatWasRestartedIsTakenInPlaceOfTheOneThatLeft) {
  hear(0);
  EXPECT_FALSE(watch_.takes(kSecond, at_ms(999)));
  EXPECT_TRUE(watch_.takes(kSecond, at_ms(1000)));
  EXPECT_TRUE(watch_.takes(kSecond, at_ms(1100)));
  EXPECT_FALSE(watch_.takes(kFirst, at_ms(1200)));
  EXPECT_THAT(logged_.text(), HasSubstr("/scan: another publisher is taken from now on"));
}

TEST_F(TopicWatchTest, OneThatOnlyTalksNonsenseIsStillTheOneThatIsFollowed) {
  hear(0);
  for (int ms = 100; ms < 3000; ms += 100) {
    EXPECT_TRUE(watch_.takes(kFirst, at_ms(ms)));
    watch_.note_bad("reason", at_ms(ms));
    EXPECT_FALSE(watch_.takes(kSecond, at_ms(ms + 50)));
  }
  EXPECT_EQ(fault_at(3000, published()), TopicFault::unusable);
  EXPECT_THAT(logged_.text(), Not(HasSubstr("another publisher")));
}

}  // namespace
}  // namespace lifeline::sources
