#include "common/recording/ros2_view.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline {
namespace {

constexpr std::size_t kMostTracks = sharing::ReplicaStore::kMaxLayers;
constexpr std::size_t kMostPathPoses = 2'000;
constexpr double kPathStepM = 0.05;

ros2::Message message_of(std::string topic, std::string_view type, std::vector<std::uint8_t> cdr) {
  return {std::move(topic), std::string(type), std::move(cdr)};
}

sharing::RevisionDigest digest_of(const MissionState& state) {
  std::vector<LayerKey> members;
  for (const auto& placement : state.common_map.placements()) members.push_back(placement.layer);
  return sharing::fingerprint(Epoch{state.directive.epoch}, members, state.store);
}

}  // namespace

std::vector<ros2::Message> Ros2View::step(const std::vector<Heard>& heard,
                                          const MissionState& state, SteadyTime now,
                                          Timestamp stamp) {
  for (const Heard& sample : heard)
    std::visit([&](const auto& message) { see(message, state, stamp); }, sample);
  if (now >= map_due_) add_map(state, now, stamp);
  if (config_.path_interval && now >= paths_due_) add_paths(now, stamp);
  return std::exchange(messages_, {});
}

void Ros2View::see(const wire::HelmetPose& pose, const MissionState& state, Timestamp stamp) {
  if (!AgentId::parse(pose.agent_id) || !pose.T_map_head.is_finite()) return;
  if (!tracks_.contains(pose.agent_id) && tracks_.size() >= kMostTracks) return;
  const std::string& name = names_.of(pose.agent_id);
  add_transforms({pose.agent_id, pose.map_id, pose.floor}, pose.T_map_head, state, stamp);
  messages_.push_back(message_of(fmt::format("/{}/pose", name), ros2::kPoseStamped,
                                 ros2::pose_stamped(stamp, name + "/map", pose.T_map_head)));
  note(pose, stamp);
}

void Ros2View::see(const wire::HelmetScan& scan, const MissionState& state, Timestamp stamp) {
  // Known already by its poses: whoever only sends scans cannot make us keep more names.
  if (!tracks_.contains(scan.agent_id) || !scan.T_map_head.is_finite()) return;
  const std::string& name = names_.of(scan.agent_id);
  ros2::LaserScan laser{scan.first_angle_rad,
                        scan.angle_step_rad,
                        0.01F,
                        static_cast<float>(std::numeric_limits<std::uint16_t>::max()) / 100.0F,
                        {}};
  laser.ranges_m.reserve(scan.ranges_cm.size());
  for (const std::uint16_t range_cm : scan.ranges_cm) {
    laser.ranges_m.push_back(range_cm == 0 ? std::numeric_limits<float>::quiet_NaN()
                                           : static_cast<float>(range_cm) / 100.0F);
  }
  // Where the head was in this sweep.
  add_transforms({scan.agent_id, scan.map_id, scan.floor}, scan.T_map_head, state, stamp);
  messages_.push_back(message_of(fmt::format("/{}/scan", name), ros2::kLaserScan,
                                 ros2::laser_scan(stamp, name + "/base_link", laser)));
}

void Ros2View::add_transforms(const wire::LayerName& layer, const Pose2& T_map_head,
                              const MissionState& state, Timestamp stamp) {
  const std::string& name = names_.of(layer.agent_id);
  std::vector<ros2::Transform> transforms;
  for (const auto& placement : state.common_map.placements()) {
    if (sharing::to_layer_name(placement.layer) != layer) continue;
    transforms.push_back(
        {std::string(kCommonFrame), name + "/map", sharing::to_pose(placement.T_fused_layer)});
  }
  transforms.push_back({name + "/map", name + "/base_link", T_map_head});
  messages_.push_back(message_of("/tf", ros2::kTfMessage, ros2::tf_message(stamp, transforms)));
}

void Ros2View::note(const wire::HelmetPose& pose, Timestamp stamp) {
  const auto layer = sharing::to_layer_key({pose.agent_id, pose.map_id, pose.floor});
  Track& track = tracks_.try_emplace(pose.agent_id, Track{*layer, {}, false}).first->second;
  if (track.layer != *layer) track = {*layer, {}, false};
  if (!track.poses.empty() &&
      (track.poses.back().pose.translation() - pose.T_map_head.translation()).norm() < kPathStepM)
    return;
  if (track.poses.size() >= 2 * kMostPathPoses) {
    // Every second one goes, so that the whole way stays.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < track.poses.size(); i += 2) track.poses[kept++] = track.poses[i];
    track.poses.resize(kept);
  }
  track.poses.push_back({stamp, pose.T_map_head});
  track.changed = true;
}

std::optional<ros2::Message> Ros2View::map_message(const MissionState& state, Timestamp stamp) {
  if (state.common_map.tiles().empty()) return std::nullopt;
  const auto grid = to_occupancy(state.common_map.to_grid());
  if (!grid) {
    spdlog::warn("/lifeline/map is left out: {}", grid.error().text);
    return std::nullopt;
  }
  return message_of("/lifeline/map", ros2::kOccupancyGrid,
                    ros2::occupancy_grid(stamp, kCommonFrame, *grid));
}

void Ros2View::add_map(const MissionState& state, SteadyTime now, Timestamp stamp) {
  map_due_ = now + config_.map_interval;
  if (state.common_map.tiles().empty()) return;
  const auto made_of = digest_of(state);
  if (made_of == map_sent_) return;
  map_sent_ = made_of;
  const auto begun = std::chrono::steady_clock::now();
  if (auto map = map_message(state, stamp)) messages_.push_back(*std::move(map));
  // A large map takes at most a twentieth of the time.
  map_due_ = std::max(map_due_, now + 20 * (std::chrono::steady_clock::now() - begun));
}

void Ros2View::add_paths(SteadyTime now, Timestamp stamp) {
  paths_due_ = now + *config_.path_interval;
  for (auto& [agent_id, track] : tracks_) {
    if (!std::exchange(track.changed, false)) continue;
    const std::string& name = names_.of(agent_id);
    messages_.push_back(message_of(fmt::format("/{}/path", name), ros2::kPath,
                                   ros2::path(stamp, name + "/map", track.poses)));
  }
}

}  // namespace lifeline
