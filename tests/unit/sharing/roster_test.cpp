#include "common/sharing/roster.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

wire::AgentStatus status(const std::string& id, std::uint64_t sequence,
                         std::uint64_t incarnation = 7) {
  wire::AgentStatus status;
  status.envelope = test::envelope(id, sequence);
  status.envelope.incarnation = incarnation;
  status.agent_id = id;
  return status;
}

class RosterTest : public testing::Test {
 protected:
  SteadyTime start_{std::chrono::hours(2)};
  Roster roster_;
};

TEST_F(RosterTest, AHelmetIsLateAfterTwoSecondsAndLostAfterFive) {
  ASSERT_TRUE(roster_.hear(status("alpha", 1), start_));
  const auto& entry = *roster_.find("alpha");
  EXPECT_EQ(Roster::presence(entry, start_ + milliseconds(1999)), Presence::fresh);
  EXPECT_EQ(Roster::presence(entry, start_ + seconds(2)), Presence::late);
  EXPECT_EQ(Roster::presence(entry, start_ + seconds(5)), Presence::lost);
  EXPECT_TRUE(roster_.present(start_ + seconds(5)).empty());
}

TEST_F(RosterTest, AnOldStatusArrivingLateChangesNothing) {
  ASSERT_TRUE(roster_.hear(status("alpha", 5), start_));
  EXPECT_FALSE(roster_.hear(status("alpha", 4), start_ + seconds(1)));
  EXPECT_EQ(roster_.find("alpha")->heard_at, start_);
}

TEST_F(RosterTest, ARebootIsNotADuplicate) {
  ASSERT_TRUE(roster_.hear(status("alpha", 90, 1), start_));
  ASSERT_TRUE(roster_.hear(status("alpha", 1, 2), start_ + seconds(3)));
  EXPECT_FALSE(roster_.find("alpha")->contested);
}

TEST_F(RosterTest, TwoThatKeepTalkingUnderOneIdAreContested) {
  ASSERT_TRUE(roster_.hear(status("alpha", 10, 1), start_));
  ASSERT_TRUE(roster_.hear(status("alpha", 1, 2), start_ + milliseconds(500)));
  EXPECT_TRUE(roster_.find("alpha")->contested);
}

TEST_F(RosterTest, SomebodyElsesStatusIsIgnored) {
  auto forged = status("alpha", 1);
  forged.envelope.sender_id = "bravo";
  EXPECT_FALSE(roster_.hear(forged, start_));
  EXPECT_EQ(roster_.find("alpha"), nullptr);
}

TEST_F(RosterTest, HoldsNoMoreThanItsLimit) {
  for (std::size_t i = 0; i < Roster::kMaxEntries; ++i) {
    ASSERT_TRUE(roster_.hear(status("h" + std::to_string(i), 1), start_));
  }
  EXPECT_FALSE(roster_.hear(status("late", 1), start_));
}

// Sent `left` after the sender's start, by a clock that tells another time.
wire::AgentStatus sent(std::uint64_t sequence, Duration left) {
  auto sample = status("alpha", sequence);
  sample.envelope.sent_at_ns = (std::chrono::hours(500'000) + left).count();
  return sample;
}

TEST_F(RosterTest, TellsHowMuchLaterThanTheQuickestAStatusCame) {
  roster_.hear(sent(1, seconds(0)), start_ + milliseconds(30));
  EXPECT_EQ(roster_.find("alpha")->delay, Duration{});
  roster_.hear(sent(2, seconds(1)), start_ + milliseconds(1010));  // the quickest
  roster_.hear(sent(3, seconds(2)), start_ + milliseconds(2710));
  wire::AgentStatus own;
  roster_.tell_peers(start_ + seconds(3), own);
  EXPECT_EQ(own.peers_heard, std::vector<std::string>{"alpha"});
  ASSERT_EQ(own.peers_delay_ms.size(), 1U);
  EXPECT_NEAR(own.peers_delay_ms[0], 700, 1);
}

TEST_F(RosterTest, ForgetsTheQuickestAfterAMinute) {
  std::uint64_t sequence = 0;
  const auto hear_for = [&](int from_s, int to_s, Duration on_its_way) {
    for (int s = from_s; s < to_s; ++s)
      roster_.hear(sent(++sequence, seconds(s)), start_ + seconds(s) + on_its_way);
  };
  hear_for(0, 30, milliseconds(0));
  hear_for(30, 58, milliseconds(400));  // the sender's clock was set
  EXPECT_NEAR(to_seconds(roster_.find("alpha")->delay), 0.4, 1e-3);
  hear_for(58, 100, milliseconds(400));
  EXPECT_NEAR(to_seconds(roster_.find("alpha")->delay), 0.0, 1e-3);
}

TEST_F(RosterTest, WhateverASenderSaysOfItsClockTheDelayIsANumber) {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  std::uint64_t sequence = 0;
  for (const std::int64_t at_ns : {kMost, kLeast, std::int64_t{0}, kLeast, kMost}) {
    auto sample = status("alpha", ++sequence);
    sample.envelope.sent_at_ns = at_ns;
    ASSERT_TRUE(roster_.hear(sample, start_ + seconds(sequence)));
    EXPECT_GE(roster_.find("alpha")->delay, Duration{});
    EXPECT_LE(roster_.find("alpha")->delay, std::chrono::hours(1));
  }
  wire::AgentStatus own;
  roster_.hear(sent(++sequence, Duration{}), start_ + seconds(sequence));
  roster_.tell_peers(start_ + seconds(sequence), own);
  EXPECT_EQ(own.peers_delay_ms.size(), 1U);
}

TEST_F(RosterTest, TheOwnDelayIsTheLeastThatAnybodyTells) {
  EXPECT_EQ(roster_.own_delay("zulu", start_), std::nullopt);
  const auto hear = [&](const std::string& id, std::vector<std::uint16_t> delays) {
    auto sample = status(id, 1);
    sample.peers_heard = {"yankee", "zulu"};
    sample.peers_delay_ms = std::move(delays);
    roster_.hear(sample, start_);
  };
  hear("alpha", {});
  hear("bravo", {1});  // tells less than it names
  EXPECT_EQ(roster_.own_delay("zulu", start_), std::nullopt);
  hear("charlie", {1, 700});
  hear("delta", {2, 300});
  EXPECT_EQ(roster_.own_delay("zulu", start_), milliseconds(300));
  EXPECT_EQ(roster_.own_delay("x-ray", start_), std::nullopt);
  EXPECT_EQ(roster_.own_delay("zulu", start_ + seconds(3)), std::nullopt);  // they are late
}

}  // namespace
}  // namespace lifeline::sharing
