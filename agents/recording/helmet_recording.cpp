#include "agents/recording/helmet_recording.hpp"

#include "common/base/log.hpp"

namespace lifeline {
namespace {

// Some minutes of a fleet's samples: a slow disk must not take the memory that SLAM works in.
constexpr std::size_t kMostWaiting = 10'000;

MissionState state_of(const sharing::HelmetSharing& helmet) {
  return {helmet.map().store(), helmet.map().directive(), helmet.map().common_map()};
}

}  // namespace

HelmetRecording::HelmetRecording(const HelmetRecordingOptions& options,
                                 const sharing::HelmetSharingConfig& config, const Clock& clock)
    : scans_(options.scans), tap_(config.speaker) {
  auto started = MissionRecording::start({options.folder, config.speaker, config.geometry,
                                          options.map_interval, config.layer, kMostWaiting},
                                         clock);
  if (started) {
    recording_ = *std::move(started);
  } else {
    spdlog::error("recording: {}; the mission goes on and is not recorded", started.error().text);
  }
}

void HelmetRecording::attach(sharing::HelmetChannels& channels) {
  channels.recording = [this] {
    return recording_ != nullptr ? recording_->status()
                                 : sharing::RecordingStatus{wire::RecordingState::failing, 0};
  };
  if (recording_ == nullptr) return;
  tap_.attach(channels.pose);
  tap_.attach(channels.tile);
  tap_.attach(channels.status);
  tap_.attach(channels.detection);
  tap_.attach(channels.alert);
  tap_.attach(channels.tiles);
  tap_.attach(channels.statuses);
  tap_.attach(channels.detections);
  tap_.attach(channels.alerts);
  tap_.attach(channels.poses);
  tap_.attach(channels.exchange.asked);
  tap_.attach(channels.exchange.sent);
  if (scans_) tap_.attach_as_reader(channels.scan);
}

void HelmetRecording::step(const sharing::HelmetSharing& helmet) {
  if (recording_ != nullptr) recording_->step(tap_.take(), state_of(helmet));
}

Result<void> HelmetRecording::finish(const sharing::HelmetSharing& helmet) {
  if (recording_ == nullptr) return {};
  step(helmet);
  return recording_->finish(state_of(helmet));
}

}  // namespace lifeline
