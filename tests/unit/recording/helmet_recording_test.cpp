#include "agents/recording/helmet_recording.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>

#include "common/bag/bag_reader.hpp"
#include "common/base/sha256.hpp"
#include "coordinator/recording/replay.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::test {
namespace {

using sharing::HelmetSharing;
using std::chrono::milliseconds;

/// Helmets on a bus, of which one records.
class HelmetRecordingTest : public sharing::HelmetSharingTest {
 protected:
  /// alpha, that records. `scanned`: it has a scan to tell of.
  void begin(HelmetRecordingOptions options = {}) {
    options.folder = records_;
    sharing::HelmetSharingConfig config{
        sharing::speaker("alpha", 1), layer("alpha"), {}, publisher_, kAmple};
    recording_ = std::make_unique<HelmetRecording>(options, config, clock_);
    auto channels = helmet_channels(bus_);
    if (nobody_reads_scans_) channels.scan = std::make_unique<Unread>();
    recording_->attach(channels);
    alpha_ = std::make_unique<HelmetSharing>(config, std::move(channels), clock_);
    sharing::HelmetState state;
    state.state = wire::AgentState::tracking;
    state.angle_step_rad = 0.1;
    state.ranges_cm = {100, 200};
    alpha_->put(state);
  }
  void step_all(std::initializer_list<HelmetSharing*> others, Duration time) {
    for (Duration passed{}; passed < time; passed += milliseconds(50)) {
      clock_.advance(milliseconds(50));
      alpha_->step();
      recording_->step(*alpha_);
      for (HelmetSharing* other : others) other->step();
    }
  }
  [[nodiscard]] std::string bag() const { return recording_->recording()->bag().string(); }
  std::vector<Heard> recorded() {
    std::vector<Heard> all;
    auto reader = bag::BagReader::open(bag());
    EXPECT_TRUE(reader);
    while (auto message = reader->next().value()) {
      auto heard = to_heard(*message);
      EXPECT_TRUE(heard) << heard.error().text;
      if (*heard) all.push_back(**std::move(heard));
    }
    return all;
  }
  std::unique_ptr<Replay> replayed() {
    auto replay = Replay::open(bag());
    EXPECT_TRUE(replay) << replay.error().text;
    while ((*replay)->step().value()) {
    }
    return *std::move(replay);
  }

  struct Unread final : wire::Outbox<wire::HelmetScan> {
    [[nodiscard]] Result<void> put(const wire::HelmetScan& /*scan*/) override {
      ADD_FAILURE() << "a scan left though nobody reads it";
      return {};
    }
    [[nodiscard]] bool has_reader() const override { return false; }
  };

  support::TemporaryFolder folder_;
  std::filesystem::path records_ = folder_.path() / "records";
  bool nobody_reads_scans_ = false;
  std::unique_ptr<HelmetRecording> recording_;  // outlives who uses its channels
  std::unique_ptr<HelmetSharing> alpha_;
};

TEST_F(HelmetRecordingTest, AReplayComesToTheMapThatTheHelmetHeld) {
  auto bravo = make_helmet("bravo");
  begin();
  alpha_->put(random_tiles({{0, 0}, {1, 0}}));
  bravo->put(random_tiles({{0, 0}, {0, -1}}));
  direct(1, {{"alpha", {}}, {"bravo", {0.7, -1.3, 2.2}}});
  step_all({bravo.get()}, milliseconds(3000));
  ASSERT_TRUE(alpha_->map().shares());
  ASSERT_TRUE(recording_->finish(*alpha_));
  const auto replay = replayed();
  EXPECT_EQ(replay->facts().recorder, "alpha");
  EXPECT_EQ(replay->facts().helmet, layer("alpha"));
  EXPECT_EQ(replay->common_map_sha256(), to_hex(alpha_->map().common_map_sha256()));
  EXPECT_EQ(replay->facts().common_map_sha256, replay->common_map_sha256());
  EXPECT_EQ(replay->refused(), 0U);
}

// The largest group is none of its concern.
TEST_F(HelmetRecordingTest, AReplayShowsTheGroupOfTheHelmetThatRecorded) {
  auto bravo = make_helmet("bravo"), charlie = make_helmet("charlie"), delta = make_helmet("delta");
  begin();
  alpha_->put(random_tiles({{0, 0}}));
  for (HelmetSharing* other : {bravo.get(), charlie.get(), delta.get()})
    other->put(random_tiles({{0, 0}, {0, -1}}));
  wire::MergeDirective directive;
  directive.envelope = envelope("coordinator", 1);
  directive.mission_id = kMission;
  directive.epoch = 1;
  for (const char* id : {"bravo", "charlie"})
    directive.members.push_back({{id, 1, 0}, 0, {}, {}, 1.0F});
  for (const char* id : {"alpha", "delta"})
    directive.members.push_back({{id, 1, 0}, 1, {}, {}, 1.0F});
  ASSERT_TRUE(coordinator_->put(directive));
  step_all({bravo.get(), charlie.get(), delta.get()}, milliseconds(3000));
  ASSERT_TRUE(alpha_->map().shares());
  ASSERT_TRUE(recording_->finish(*alpha_));
  const auto replay = replayed();
  EXPECT_EQ(replay->common_map_sha256(), to_hex(alpha_->map().common_map_sha256()));
  EXPECT_NE(replay->common_map_sha256(), to_hex(bravo->map().common_map_sha256()));
}

TEST_F(HelmetRecordingTest, WhatItSaysStandsInItOnceThoughItComesBack) {
  begin();
  alpha_->put(random_tiles({{0, 0}}));
  step_all({}, milliseconds(3000));
  ASSERT_TRUE(recording_->finish(*alpha_));
  std::set<std::uint64_t> statuses;
  std::size_t parts = 0, poses = 0;
  for (const Heard& heard : recorded()) {
    if (const auto* status = std::get_if<wire::AgentStatus>(&heard)) {
      EXPECT_TRUE(statuses.insert(status->envelope.sequence).second);
      EXPECT_EQ(status->recording, wire::RecordingState::on);
    }
    parts += std::holds_alternative<wire::TsdTile>(heard) ? 1 : 0;
    poses += std::holds_alternative<wire::HelmetPose>(heard) ? 1 : 0;
  }
  EXPECT_GE(statuses.size(), 2U);
  EXPECT_GE(poses, 10U);
  const auto* held = alpha_->map().store().find(layer("alpha"), {0, 0});
  ASSERT_NE(held, nullptr);
  EXPECT_EQ(parts, tile_samples(layer("alpha"), {0, 0}, held->revision.value, *held->cells).size());
}

TEST_F(HelmetRecordingTest, ItsOwnScansAreRecordedWithoutGoingOverTheRadio) {
  nobody_reads_scans_ = true;
  HelmetRecordingOptions options;
  options.scans = true;
  begin(options);
  step_all({}, milliseconds(2000));
  ASSERT_TRUE(recording_->finish(*alpha_));
  const auto all = recorded();
  const auto is_scan = [](const Heard& heard) {
    return std::holds_alternative<wire::HelmetScan>(heard);
  };
  EXPECT_GE(std::ranges::count_if(all, is_scan), 5);
}

TEST_F(HelmetRecordingTest, NoScansAreMadeForARecordingThatWantsNone) {
  nobody_reads_scans_ = true;
  begin();
  step_all({}, milliseconds(2000));
  ASSERT_TRUE(recording_->finish(*alpha_));
  for (const Heard& heard : recorded())
    EXPECT_FALSE(std::holds_alternative<wire::HelmetScan>(heard));
}

TEST_F(HelmetRecordingTest, WhereTheFolderCannotBeMadeTheHelmetGoesOnAndSaysSo) {
  std::ofstream(records_) << "a file, and no folder";
  begin();
  EXPECT_EQ(recording_->recording(), nullptr);
  step_all({}, milliseconds(2000));
  EXPECT_EQ(alpha_->status().recording, wire::RecordingState::failing);
  EXPECT_TRUE(recording_->finish(*alpha_));
}

TEST_F(HelmetRecordingTest, AfterAFullDiskTheRecordingHoldsAllThatIsKnown) {
  auto bravo = make_helmet("bravo");
  begin();
  direct(1, {{"alpha", {}}, {"bravo", {0.7, -1.3, 2.2}}});
  const auto wait_for = [&](wire::RecordingState state) {
    for (int i = 0; i < 5000 && alpha_->status().recording != state; ++i) {
      step_all({bravo.get()}, milliseconds(100));
      std::this_thread::sleep_for(milliseconds(2));  // the recorder's thread
    }
    EXPECT_EQ(alpha_->status().recording, state);
  };
  {
    const FullDisk full(4096);
    bravo->put(random_tiles({{0, 0}, {0, -1}}));
    wait_for(wire::RecordingState::failing);
    alpha_->put(random_tiles({{0, 0}, {1, 0}}));
    step_all({bravo.get()}, milliseconds(3000));
  }
  wait_for(wire::RecordingState::on);
  ASSERT_TRUE(recording_->finish(*alpha_));
  EXPECT_GT(alpha_->status().samples_unrecorded, 0U);
  ASSERT_TRUE(alpha_->map().shares());
  EXPECT_EQ(replayed()->common_map_sha256(), to_hex(alpha_->map().common_map_sha256()));
}

}  // namespace
}  // namespace lifeline::test
