#include "coordinator/export/collect_story.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/files/map_file.hpp"
#include "common/files/occupancy_image.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "coordinator/recording/replay.hpp"

namespace lifeline {
namespace {

constexpr std::size_t kMostPoses = 10'000'000;
constexpr std::size_t kMostEvents = 100'000;

/// Notes while a recording is played what is gone at its end.
class Collector {
 public:
  explicit Collector(std::string mission_id) : mission_id_(std::move(mission_id)) {}

  void hear(const Heard& heard, Timestamp at) {
    std::visit(
        [&]<typename Message>(const Message& message) {
          if (!sharing::check_envelope(message.envelope, mission_id_)) return;
          if constexpr (std::is_same_v<Message, wire::HelmetPose>) note(message, at);
          if constexpr (std::is_same_v<Message, wire::Alert>) note(message, at);
          if constexpr (std::is_same_v<Message, wire::MergeEvidence>) note(message, at);
        },
        heard);
  }

  void move_into(MissionStory& story) {
    for (auto& [layer, track] : tracks_) story.tracks.push_back(std::move(track));
    story.alerts = std::move(alerts_);
    story.merges = std::move(merges_);
  }

 private:
  void note(const wire::HelmetPose& pose, Timestamp at) {
    const auto layer = sharing::to_layer_key({pose.agent_id, pose.map_id, pose.floor});
    if (!layer || !pose.T_map_head.is_finite() || poses_ >= kMostPoses) return;
    if (!tracks_.contains(*layer) && tracks_.size() >= sharing::ReplicaStore::kMaxLayers) return;
    HelmetTrack& track =
        tracks_.try_emplace(*layer, HelmetTrack{*layer, std::nullopt, {}, {}}).first->second;
    track.poses.push_back({at, pose.T_map_head});
    track.trust_percent.push_back(pose.trust_percent);
    ++poses_;
  }
  void note(const wire::Alert& alert, Timestamp at) {
    if (alerts_.size() < kMostEvents) alerts_.push_back({at, alert});
  }
  void note(const wire::MergeEvidence& evidence, Timestamp at) {
    const auto [last, is_new] = verdicts_.try_emplace({evidence.a, evidence.b}, evidence.verdict);
    if (!is_new && last->second == evidence.verdict) return;
    last->second = evidence.verdict;
    if (merges_.size() < kMostEvents) merges_.push_back({at, evidence});
  }

  std::string mission_id_;
  std::map<LayerKey, HelmetTrack> tracks_;
  std::size_t poses_ = 0;
  std::map<std::pair<wire::LayerName, wire::LayerName>, wire::Verdict> verdicts_;
  std::vector<Recorded<wire::Alert>> alerts_;
  std::vector<Recorded<wire::MergeEvidence>> merges_;
};

void add_common_map(const Coordinator& coordinator, MissionStory& story) {
  if (coordinator.common_map().tiles().empty()) return;
  auto grid = to_occupancy(coordinator.common_map().to_grid());
  if (!grid) {
    spdlog::warn("the common map is left out: {}", grid.error().text);
    return;
  }
  StoryMap map{"map", "", *std::move(grid), {}};
  for (std::size_t i = 0; i < story.tracks.size(); ++i) {
    for (const auto& placement : coordinator.common_map().placements()) {
      if (placement.layer != story.tracks[i].layer) continue;
      story.tracks[i].T_common_map = sharing::to_pose(placement.T_fused_layer);
      map.tracks.push_back(i);
    }
  }
  map.title = fmt::format("Common map of {} helmets", map.tracks.size());
  story.maps.push_back(std::move(map));
}

void add_own_maps(const Coordinator& coordinator, MissionStory& story) {
  for (std::size_t i = 0; i < story.tracks.size(); ++i) {
    const HelmetTrack& track = story.tracks[i];
    const auto* layer = coordinator.store().find(track.layer);
    if (track.T_common_map || layer == nullptr) continue;
    auto grid = to_occupancy(sharing::to_grid(*layer, coordinator.store().geometry()));
    if (!grid) {
      spdlog::warn("the map of {} is left out: {}", to_string(track.layer), grid.error().text);
      continue;
    }
    story.maps.push_back({"map-" + track.name(),
                          fmt::format("Map of {}, not merged", to_string(track.layer)),
                          *std::move(grid),
                          {i}});
  }
}

}  // namespace

Result<MissionStory> story_of_recording(const std::filesystem::path& bag) {
  auto opened = Replay::open(bag.string());
  if (!opened) return forward_error(opened);
  Replay& replay = **opened;
  Collector collector(replay.facts().mission_id);
  replay.set_listener([&](const Heard& heard, Timestamp at) { collector.hear(heard, at); });
  for (;;) {
    const auto more = replay.step();
    if (!more) return forward_error(more);
    if (!*more) break;
  }
  MissionStory story;
  story.mission_id = replay.facts().mission_id;
  story.first = replay.first();
  story.last = replay.now();
  story.common_map_sha256 = replay.common_map_sha256();
  story.finds = replay.coordinator().detections();
  collector.move_into(story);
  add_common_map(replay.coordinator(), story);
  add_own_maps(replay.coordinator(), story);
  return story;
}

Result<MissionStory> story_of_map(const std::filesystem::path& file) {
  MissionStory story;
  if (file.extension() != ".lifemap") {
    auto grid = files::read_occupancy_image(file);
    if (!grid) return forward_error(grid);
    story.maps.push_back({"map", file.stem().string(), *std::move(grid), {}});
    return story;
  }
  auto saved = files::load_map(file);
  if (!saved) return forward_error(saved);
  auto grid = to_occupancy(saved->grid);
  if (!grid) return fail(grid.error().code, "{}: {}", file.string(), grid.error().text);
  story.maps.push_back({"map", "Map of " + to_string(saved->layer), *std::move(grid), {0}});
  if (!saved->trajectory.empty()) {
    story.first = saved->trajectory.front().stamp;
    story.last = saved->trajectory.back().stamp;
  }
  story.tracks.push_back({saved->layer, std::nullopt, std::move(saved->trajectory), {}});
  return story;
}

}  // namespace lifeline
