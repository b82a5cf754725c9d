#pragma once

#include <filesystem>
#include <memory>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/recording/message_tap.hpp"
#include "common/recording/mission_recording.hpp"

namespace lifeline {

struct HelmetRecordingOptions {
  std::filesystem::path folder;  ///< takes a new bag of its own
  bool scans = false;            ///< the helmet's own
  Duration map_interval = std::chrono::seconds(5);
};

/// A helmet's recording of the mission (docs/recording.md), as it takes part in it: what it hears,
/// and what it says. Nothing more goes over the radio for it. Used by the sharing thread alone, and
/// written by one of its own: neither the mission nor SLAM waits for the disk.
class HelmetRecording {
 public:
  /// Begins a recording of who draws `config.layer`. Where the disk refuses, the helmet goes on
  /// without, and its status says so.
  HelmetRecording(const HelmetRecordingOptions& options, const sharing::HelmetSharingConfig& config,
                  const Clock& clock);
  HelmetRecording(const HelmetRecording&) = delete;
  HelmetRecording& operator=(const HelmetRecording&) = delete;
  ~HelmetRecording() = default;

  /// Notes what passes, before the helmet takes the channels. They must not be used any more once
  /// this is gone.
  void attach(sharing::HelmetChannels& channels);
  /// After each step of the helmet.
  void step(const sharing::HelmetSharing& helmet);
  /// Records how it ended, and closes the bag; waits for the disk.
  [[nodiscard]] Result<void> finish(const sharing::HelmetSharing& helmet);

  /// nullptr where the disk refused.
  [[nodiscard]] const MissionRecording* recording() const { return recording_.get(); }

 private:
  bool scans_;
  MessageTap tap_;
  std::unique_ptr<MissionRecording> recording_;
};

}  // namespace lifeline
