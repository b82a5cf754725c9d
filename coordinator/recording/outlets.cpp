#include "coordinator/recording/outlets.hpp"

#include <sstream>

#include "common/base/log.hpp"
#include "common/dds/open_channel.hpp"
#include "coordinator/recording/coordinator_tap.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

Result<std::unique_ptr<MissionRecording>> open_recording(const proto::CoordinatorConfig& config,
                                                         const sharing::Speaker& speaker,
                                                         const Clock& clock) {
  if (config.recording().folder() == "off") return nullptr;
  return MissionRecording::start({config.recording().folder(),
                                  speaker,
                                  {config.grid().cell_size_m(), config.grid().truncation_m()},
                                  from_seconds(config.recording().map_interval_s())},
                                 clock);
}

Result<std::unique_ptr<Ros2Out>> open_ros2(
    const proto::CoordinatorConfig& config, const std::string& name,
    const std::optional<std::filesystem::path>& config_file) {
  if (!config.ros2().out()) return nullptr;
  const auto qos = dds::qos_file(std::nullopt, config_file, config.ros2().qos_profiles());
  if (!qos) return forward_error(qos);
  return Ros2Out::open({config.ros2().domain_id(), *qos, name});
}

Result<std::unique_ptr<foxglove::FoxgloveServer>> open_foxglove(
    const proto::CoordinatorConfig& config) {
  if (!config.foxglove().out()) return nullptr;
  foxglove::ServerOptions options{"Lifeline " + config.mission().mission_id(),
                                  config.foxglove().address(),
                                  static_cast<std::uint16_t>(config.foxglove().port()),
                                  {}};
  std::istringstream origins(config.foxglove().origins());
  for (std::string origin; origins >> origin;) options.origins.push_back(origin);
  auto server = foxglove::FoxgloveServer::start(std::move(options));
  if (server) {
    spdlog::info("Foxglove connects to ws://{}:{}", config.foxglove().address(), (*server)->port());
  }
  return server;
}

}  // namespace

Result<void> Outlets::open(const proto::CoordinatorConfig& config,
                           const std::optional<std::filesystem::path>& config_file,
                           CoordinatorChannels& channels, dds::Participant& participant) {
  auto recording = open_recording(config, speaker_, clock_);
  if (!recording) return forward_error(recording);
  auto ros2 = open_ros2(config, speaker_.id.text(), config_file);
  if (!ros2) return forward_error(ros2);
  auto foxglove = open_foxglove(config);
  if (!foxglove) return forward_error(foxglove);
  recording_ = *std::move(recording);
  ros2_ = *std::move(ros2);
  foxglove_ = *std::move(foxglove);
  const bool shown = ros2_ != nullptr || foxglove_ != nullptr;
  if (recording_ == nullptr && !shown) return {};
  const Duration map_interval = from_seconds(config.ros2().map_interval_s());
  view_ = Ros2View({map_interval, map_interval});
  tap_channels(channels, tap_);
  if (recording_ != nullptr) channels.recording = [this] { return recording_->status(); };
  const bool scans =
      (recording_ != nullptr && config.recording().scans()) || (shown && config.ros2().scans());
  if (!scans) return {};
  // Helmets send them only while somebody listens.
  Result<void> opened;
  std::unique_ptr<wire::Inbox<wire::HelmetScan>> inbox;
  dds::open_inbox(participant, inbox, opened);
  tap_.listen(std::move(inbox));
  return opened;
}

void Outlets::show(const std::vector<ros2::Message>& messages) {
  if (ros2_ != nullptr) ros2_->send(messages);
  if (foxglove_ != nullptr) foxglove_->send(clock_.wall_now(), messages);
}

void Outlets::step(const Coordinator& coordinator) {
  const std::vector<Heard> heard = tap_.take();
  const MissionState state = state_of(coordinator);
  if (recording_ != nullptr) recording_->step(heard, state);
  if (ros2_ == nullptr && foxglove_ == nullptr) return;
  show(view_.step(heard, state, clock_.steady_now(), clock_.wall_now()));
}

Result<void> Outlets::finish(const Coordinator& coordinator) {
  step(coordinator);
  // The map as it is at the end.
  if (auto map = Ros2View::map_message(state_of(coordinator), clock_.wall_now()))
    show({*std::move(map)});
  return recording_ == nullptr ? Result<void>{} : recording_->finish(state_of(coordinator));
}

}  // namespace lifeline
