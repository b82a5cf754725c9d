#include "coordinator/watch_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class WatchTableTest : public testing::Test {
 protected:
  void hear(const std::string& id, std::uint8_t map, std::uint64_t incarnation = 7) {
    wire::AgentStatus status;
    status.envelope = test::envelope(id, ++sequence_);
    status.envelope.incarnation = incarnation;
    status.agent_id = id;
    status.state = wire::AgentState::tracking;
    status.common_map_sha256.fill(map);
    ASSERT_TRUE(roster_.hear(status, now_));
  }
  std::uint64_t sequence_ = 0;
  SteadyTime now_{std::chrono::hours(1)};
  sharing::Roster roster_;
};

TEST_F(WatchTableTest, TellsWhetherAllHoldOneMap) {
  EXPECT_EQ(agreement(roster_, now_), "nobody heard yet");
  hear("alpha", 0);
  EXPECT_EQ(agreement(roster_, now_), "1 heard; no common map yet");
  hear("alpha", 0xab);
  hear("bravo", 0xcd);
  hear("charlie", 0xab);
  EXPECT_EQ(agreement(roster_, now_), "2 of 3 hold one map");
  hear("bravo", 0xab);
  EXPECT_EQ(agreement(roster_, now_), "all 3 hold one map");
}

TEST_F(WatchTableTest, SaysWhoCannotRecordAndWhatIsMissingAfterwards) {
  wire::AgentStatus status;
  status.envelope = test::envelope("base", ++sequence_);
  status.agent_id = "base";
  status.role = wire::Role::coordinator;
  status.recording = wire::RecordingState::on;
  ASSERT_TRUE(roster_.hear(status, now_));
  EXPECT_THAT(watch_table(roster_, now_), Not(HasSubstr("ecord")));
  status.envelope = test::envelope("base", ++sequence_);
  status.recording = wire::RecordingState::failing;
  status.samples_unrecorded = 12;
  ASSERT_TRUE(roster_.hear(status, now_));
  EXPECT_THAT(watch_table(roster_, now_), HasSubstr("base: DOES NOT RECORD, its disk refuses (12"));
  status.envelope = test::envelope("base", ++sequence_);
  status.recording = wire::RecordingState::on;
  ASSERT_TRUE(roster_.hear(status, now_));
  EXPECT_THAT(watch_table(roster_, now_),
              HasSubstr("base: 12 messages are missing from its recording"));
}

TEST_F(WatchTableTest, SaysOfEachHowOldItsWordIs) {
  hear("alpha", 0xab);
  now_ += std::chrono::seconds(3);
  hear("bravo", 0);
  EXPECT_THAT(watch_table(roster_, now_),
              AllOf(HasSubstr("LATE 3 s"), HasSubstr("abababab"), HasSubstr("own only")));
  now_ += std::chrono::seconds(3);
  EXPECT_THAT(watch_table(roster_, now_), HasSubstr("NOT HEARD FOR 6 s"));
  EXPECT_EQ(agreement(roster_, now_), "1 heard; no common map yet");
}

TEST_F(WatchTableTest, NamesAnIdThatIsUsedTwice) {
  hear("alpha", 0);
  EXPECT_THAT(watch_table(roster_, now_), Not(HasSubstr("used twice")));
  hear("alpha", 0, 8);
  EXPECT_THAT(watch_table(roster_, now_), HasSubstr("alpha: this name is used twice"));
}

}  // namespace
}  // namespace lifeline
