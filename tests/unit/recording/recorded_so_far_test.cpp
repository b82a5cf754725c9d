#include "common/recording/recorded_so_far.hpp"

#include <gmock/gmock.h>

#include "tests/support/recorded_mission.hpp"

namespace lifeline::test {
namespace {

using RecordedSoFarTest = RecordedMission;

TEST_F(RecordedSoFarTest, PlaysToWhatTheCoordinatorHoldsWhileItIsRecorded) {
  begin();
  put_tile(1, 1);
  put_tile(2, 1);
  wait_until_written();
  auto replay = Replay::open(recording_->so_far()).value();
  while (replay->step().value()) {
  }
  EXPECT_EQ(replay->coordinator().store().digest(alpha_), coordinator_->store().digest(alpha_));
  EXPECT_EQ(replay->facts().mission_id, kMission);

  put_tile(1, 2);
  wait_until_written();
  while (replay->step().value()) {
  }
  EXPECT_EQ(replay->coordinator().store().digest(alpha_), coordinator_->store().digest(alpha_))
      << "and goes on where more comes";
  EXPECT_EQ(replay->now(), replay->span().value().last);
}

TEST_F(RecordedSoFarTest, GivesOnlyWhatAReplayNeeds) {
  begin();
  put_tile(1, 1);
  wait_until_written();
  std::set<std::string> names;
  const auto source = recording_->so_far();
  while (const auto message = source->next().value()) names.insert(message->topic.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"/lifeline/recording", "/lifeline/pose",
                                            "/lifeline/tsd_tile", "/lifeline/agent_status"}));
  EXPECT_THAT(names, testing::Not(testing::Contains("/tf")));
  EXPECT_THAT(names, testing::Not(testing::Contains("/alpha/pose")));
}

TEST_F(RecordedSoFarTest, EndsWithTheRecording) {
  begin();
  put_pose(1.0);
  wait_until_written();
  const auto source = recording_->so_far();
  ASSERT_TRUE(source->next().value());
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  Result<std::optional<bag::Message>> last = source->next();
  while (last && *last) last = source->next();
  ASSERT_FALSE(last);
  EXPECT_THAT(last.error().text, testing::HasSubstr("is closed"));
}

}  // namespace
}  // namespace lifeline::test
