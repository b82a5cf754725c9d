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

// What a helmet that hears zulu and echoes its clock so says.
wire::AgentStatus echoing(const std::string& id, std::vector<std::uint32_t> echoes_ms) {
  auto sample = status(id, 1);
  sample.peers_heard = {"yankee", "zulu"};
  sample.peers_echo_ms = std::move(echoes_ms);
  return sample;
}

TEST_F(RosterTest, ARoundTripIsWhatTwoSamplesAreOnTheirWayAndNotWhatTheyWereKept) {
  // Zulu's clock shows half a million hours, alpha's nothing of the kind.
  const Timestamp sent_at{std::chrono::hours(500'000)};
  Roster of_alpha;
  auto of_zulu = status("zulu", 1);
  of_zulu.envelope.sent_at_ns = sent_at.time_since_epoch().count();
  of_alpha.hear(of_zulu, SteadyTime(seconds(77)));
  auto answer = status("alpha", 1);
  of_alpha.tell_peers(SteadyTime(milliseconds(77'900)), answer);
  EXPECT_EQ(answer.peers_heard, std::vector<std::string>{"zulu"});
  // There in 300 ms, kept 900 ms, back in 100 ms; looked at a second later.
  roster_.hear(answer, start_);
  const auto took = roster_.round_trip("zulu", start_ + seconds(1), sent_at + milliseconds(2300));
  ASSERT_TRUE(took);
  EXPECT_NEAR(to_seconds(*took), 0.4, 0.002);
}

TEST_F(RosterTest, OfAllRoundTripsTheLeastCounts) {
  const Timestamp at{seconds(50)};
  EXPECT_EQ(roster_.round_trip("zulu", start_, at), std::nullopt);
  roster_.hear(echoing("alpha", {}), start_);
  roster_.hear(echoing("bravo", {1}), start_);  // says less than it names
  EXPECT_EQ(roster_.round_trip("zulu", start_, at), std::nullopt);
  roster_.hear(echoing("charlie", {1, 49'300}), start_);
  roster_.hear(echoing("delta", {2, 49'700}), start_);
  EXPECT_EQ(roster_.round_trip("zulu", start_, at), milliseconds(300));
  EXPECT_EQ(roster_.round_trip("x-ray", start_, at), std::nullopt);
  EXPECT_EQ(roster_.round_trip("zulu", start_ + seconds(3), at), std::nullopt);  // they are late
}

TEST_F(RosterTest, AClockThatWasSetOrAnEchoThatIsNoneGivesNoNegativeRoundTrip) {
  const Timestamp at{seconds(50)};
  for (const std::uint32_t echo_ms : {0xffffffffU, 0x80000000U, 0x7fffffffU, 60'000U}) {
    Roster roster;
    roster.hear(echoing("alpha", {1, echo_ms}), start_);
    EXPECT_GE(roster.round_trip("zulu", start_, at), Duration{}) << echo_ms;
  }
  auto sample = status("alpha", 1);
  for (const auto at_ns :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    ++sample.envelope.sequence;
    sample.envelope.sent_at_ns = at_ns;
    ASSERT_TRUE(roster_.hear(sample, start_));
    wire::AgentStatus own;
    roster_.tell_peers(start_ + seconds(1), own);
    EXPECT_EQ(own.peers_echo_ms.size(), 1U);
  }
}

}  // namespace
}  // namespace lifeline::sharing
