#include "common/sharing/roster.hpp"

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

}  // namespace
}  // namespace lifeline::sharing
