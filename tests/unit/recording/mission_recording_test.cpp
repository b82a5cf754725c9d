#include "common/recording/mission_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/dds/cdr_samples.hpp"
#include "common/ros2/cdr_reader.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/recorded_mission.hpp"

namespace lifeline::test {
namespace {

using MissionRecordingTest = RecordedMission;

TEST_F(MissionRecordingTest, WhatIsHeardIsRecordedAsItCameAndForRos2) {
  begin();
  put_tile(1, 1);
  put_pose(1.5);
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  const auto all = recorded();
  EXPECT_EQ(all.front().topic.name, "/lifeline/recording");
  EXPECT_EQ(all.back().topic.name, "/lifeline/recording");
  EXPECT_EQ(count("/lifeline/tsd_tile"), tile_samples_of({1, 0}, 1).size());
  EXPECT_EQ(count("/alpha/pose"), 1U);
  EXPECT_EQ(count("/tf"), 1U);
  for (const auto& message : all) {
    if (message.topic.name != "/lifeline/pose") continue;
    const auto heard = to_heard(message).value();
    ASSERT_TRUE(heard);
    EXPECT_EQ(std::get<wire::HelmetPose>(*heard).T_map_head.x_m, 1.5);
  }
  EXPECT_EQ(replayed(alpha_), coordinator_->store().digest(alpha_));
}

TEST_F(MissionRecordingTest, SamplesOfAnotherMissionAreLeftOut) {
  begin();
  auto foreign = tile_samples_of({1, 0}, 1).front();
  foreign.envelope.mission_id = "another";
  put(foreign);
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  EXPECT_EQ(count("/lifeline/tsd_tile"), 0U);
}

TEST_F(MissionRecordingTest, WhatWasHeldBeforeItBeganIsRecordedToo) {
  put_tile(1, 1);
  put_tile(2, 5);
  begin();
  step();
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  EXPECT_EQ(replayed(alpha_), coordinator_->store().digest(alpha_));
}

TEST_F(MissionRecordingTest, TwoBegunWithinASecondAreTwoRecordings) {
  begin();
  const auto first = std::move(recording_);
  begin();
  EXPECT_NE(first->bag(), recording_->bag());
}

TEST_F(MissionRecordingTest, AfterAFullDiskTheRecordingSaysWhatIsMissingAndHoldsAllThatIsKnown) {
  begin();
  const auto wait_for = [&](wire::RecordingState state) {
    for (int i = 0; i < 5000 && recording_->status().state != state; ++i) {
      put_pose(0.1 * i);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the recorder's thread
    }
    EXPECT_EQ(recording_->status().state, state);
  };
  {
    const FullDisk full(4096);
    put_tile(1, 1);
    wait_for(wire::RecordingState::failing);
    put_tile(2, 1);
  }
  wait_for(wire::RecordingState::on);
  put_tile(3, 1);
  ASSERT_TRUE(recording_->finish(state_of(*coordinator_)));
  EXPECT_GT(recording_->status().unrecorded, 0U);
  EXPECT_EQ(replayed(alpha_), coordinator_->store().digest(alpha_));
}

TEST_F(MissionRecordingTest, ScansAreSweepsOfTheHeadWithWhatIsNotKnownLeftOpen) {
  Ros2View view({std::chrono::seconds(1), std::nullopt});
  wire::HelmetPose pose;
  pose.agent_id = "ff-1";
  pose.map_id = 1;
  wire::HelmetScan scan;
  scan.agent_id = "ff-1";
  scan.map_id = 1;
  scan.first_angle_rad = -1.0F;
  scan.angle_step_rad = 0.5F;
  scan.ranges_cm = {250, 0};
  const auto messages =
      view.step({pose, scan}, state_of(*coordinator_), clock_.steady_now(), Timestamp{});
  ASSERT_EQ(messages.size(), 4U);
  EXPECT_EQ(messages[0].topic, "/tf");
  EXPECT_EQ(messages[1].topic, "/ff_1/pose");
  EXPECT_EQ(messages[3].topic, "/ff_1/scan");
  auto reader = ros2::CdrReader::open_cdr(messages[3].cdr).value();
  (void)reader.read<std::int32_t>();
  (void)reader.read<std::uint32_t>();
  EXPECT_EQ(reader.read_text(100), "ff_1/base_link");
  EXPECT_EQ(reader.read<float>(), -1.0F);
  EXPECT_EQ(reader.read<float>(), -0.5F);
  for (int i = 0; i < 5; ++i) (void)reader.read<float>();
  const auto ranges = reader.read_floats(10);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[0], 2.5F);
  EXPECT_TRUE(std::isnan(ranges[1]));
}

TEST(Replay, WhatIsNoRecordingOfOursIsRefusedInOneLine) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& text) {
    auto writer = bag::BagWriter::create(folder.path() / name).value();
    EXPECT_TRUE(writer.append({"/lifeline/recording", "std_msgs/msg/String"},
                              bag::Durability::volatile_, Timestamp{}, ros2::text(text)));
    EXPECT_TRUE(writer.close());
    const auto opened = Replay::open((folder.path() / name).string());
    return opened ? std::string("accepted") : opened.error().text;
  };
  EXPECT_THAT(refusal("a", "hello"), testing::HasSubstr("is no recording of Lifeline"));
  EXPECT_THAT(refusal("b", "{}"), testing::HasSubstr("is no recording of Lifeline"));
  EXPECT_THAT(refusal("c", R"({"format":2})"), testing::HasSubstr("newer version"));
  EXPECT_THAT(refusal("d", R"({"format":1,"mission_id":"m","cell_size_m":1e-9,"truncation_m":1})"),
              testing::HasSubstr("makes no sense"));
  EXPECT_EQ(refusal("e", R"({"format":1,"mission_id":"m","cell_size_m":0.05,"truncation_m":0.15})"),
            "accepted");
}

}  // namespace
}  // namespace lifeline::test
