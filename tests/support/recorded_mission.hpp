#pragma once

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "common/bag/bag_reader.hpp"
#include "common/recording/mission_recording.hpp"
#include "common/wire/loopback.hpp"
#include "coordinator/recording/coordinator_tap.hpp"
#include "coordinator/recording/replay.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/sharing_samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {

inline const sharing::Speaker kVehicle{AgentId::parse("vehicle").value(), kMission, Incarnation{3}};

/// A coordinator on a bus, recorded; its clock moves by a tenth of a second with each step.
class RecordedMission : public testing::Test {
 protected:
  RecordedMission() {
    auto channels = coordinator_channels(bus_);
    tap_channels(channels, tap_);
    coordinator_ = std::make_unique<Coordinator>(CoordinatorSettings{kVehicle, {}, {}, {}},
                                                 std::move(channels), worker_, clock_);
  }
  void begin() {
    auto started = MissionRecording::start({folder_.path() / "records", kVehicle, {}}, clock_);
    ASSERT_TRUE(started) << started.error().text;
    recording_ = *std::move(started);
  }
  void step() {
    clock_.advance(std::chrono::milliseconds(100));
    coordinator_->step();
    const auto heard = tap_.take();
    if (recording_ != nullptr) recording_->step(heard, state_of(*coordinator_));
  }
  template <typename Message>
  void put(const Message& message) {
    ASSERT_TRUE(bus_.writer<Message>()->put(message));
    step();
  }
  void put_tile(int x, std::uint64_t revision) {
    for (const auto& part : tile_samples_of({x, 0}, revision)) put(part);
  }
  [[nodiscard]] std::vector<wire::TsdTile> tile_samples_of(TileIndex tile, std::uint64_t revision) {
    std::mt19937 random(static_cast<std::uint32_t>(revision));
    return tile_samples(alpha_, tile, revision, random_tile(random));
  }
  void put_pose(double x_m) {
    wire::HelmetPose pose;
    pose.envelope = envelope("alpha", ++poses_);
    pose.agent_id = "alpha";
    pose.map_id = 1;
    pose.T_map_head = {x_m, 0.0, 0.0};
    put(pose);
  }
  /// All that was recorded can be read back.
  void wait_until_written() {
    put_pose(0.0);
    std::uint64_t read = 0;
    const auto source = recording_->so_far();
    for (int i = 0; i < 5000 && read < poses_; ++i) {
      while (const auto next = source->next().value())
        read += next->topic.name == "/lifeline/pose" ? 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the recorder's thread
    }
    ASSERT_EQ(read, poses_);
  }
  std::vector<bag::Message> recorded() {
    std::vector<bag::Message> all;
    auto reader = bag::BagReader::open(recording_->bag().string());
    EXPECT_TRUE(reader);
    while (auto message = reader->next().value()) all.push_back(*std::move(message));
    return all;
  }
  std::size_t count(const std::string& topic) {
    const auto all = recorded();
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const auto& message) { return message.topic.name == topic; }));
  }
  /// The layers that a replay comes to, as digests.
  sharing::RevisionDigest replayed(const LayerKey& layer) {
    auto replay = Replay::open(recording_->bag().string());
    EXPECT_TRUE(replay) << replay.error().text;
    while ((*replay)->step().value()) {
    }
    return (*replay)->coordinator().store().digest(layer);
  }

  const LayerKey alpha_ = layer("alpha");
  support::TemporaryFolder folder_;
  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  MessageTap tap_{kVehicle};
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<MissionRecording> recording_;
  std::uint64_t poses_ = 0;
};

}  // namespace lifeline::test
