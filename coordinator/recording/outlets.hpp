#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "common/recording/message_tap.hpp"
#include "common/recording/mission_recording.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/foxglove/foxglove_server.hpp"
#include "coordinator/recording/ros2_out.hpp"

namespace lifeline::proto {
class CoordinatorConfig;
}  // namespace lifeline::proto

namespace lifeline {

/// Where a running coordinator's mission goes besides its helmets: a recording, ROS 2's tools, and
/// Foxglove.
/// Each only where it is configured. Must outlive the coordinator whose channels it was opened on.
class Outlets {
 public:
  Outlets(sharing::Speaker speaker, const Clock& clock)
      : speaker_(std::move(speaker)), clock_(clock), tap_(speaker_) {}
  Outlets(const Outlets&) = delete;
  Outlets& operator=(const Outlets&) = delete;
  ~Outlets() = default;

  /// Opens what `config` asks for and taps the channels, before the coordinator takes them.
  /// `config_file`: where it came from, for files that it names.
  [[nodiscard]] Result<void> open(const proto::CoordinatorConfig& config,
                                  const std::optional<std::filesystem::path>& config_file,
                                  CoordinatorChannels& channels, dds::Participant& participant);
  /// After each step of the coordinator.
  void step(const Coordinator& coordinator);
  /// Closes the recording; waits for the disk.
  [[nodiscard]] Result<void> finish(const Coordinator& coordinator);

  /// nullptr where nothing is recorded.
  [[nodiscard]] MissionRecording* recording() const { return recording_.get(); }

 private:
  void show(const std::vector<ros2::Message>& messages);

  sharing::Speaker speaker_;
  const Clock& clock_;
  MessageTap tap_;
  std::unique_ptr<MissionRecording> recording_;
  Ros2View view_{{}};  ///< of the two below
  std::unique_ptr<Ros2Out> ros2_;
  std::unique_ptr<foxglove::FoxgloveServer> foxglove_;
};

}  // namespace lifeline
