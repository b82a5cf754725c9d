#include "coordinator/recording/digest.hpp"

#include <type_traits>
#include <variant>

#include "common/sharing/accept.hpp"

namespace lifeline {
namespace {

// What the share of lost poses is told from: its last two windows.
constexpr std::size_t kRecentPoses = 2 * sharing::PoseWatch::kWindow;

}  // namespace

Digest::Digest(const std::map<LayerKey, Coordinator::Path>& ways) {
  for (const auto& [layer, way] : ways) {
    if (!way.empty()) ways_[sharing::to_layer_name(layer)].last_m = way.back();
  }
}

void Digest::take(Timestamp wall, SteadyTime steady, Heard heard) {
  const Place place = entries_.size();
  const bool kept = std::visit(
      [&]<typename Message>(const Message& message) {
        if constexpr (std::is_base_of_v<wire::TsdTile, Message>)
          return note(static_cast<const wire::TsdTile&>(message), place);
        if constexpr (std::is_same_v<Message, wire::HelmetPose> ||
                      std::is_same_v<Message, wire::AgentStatus>)
          return note(message, place);
        return true;
      },
      heard);
  if (kept) entries_.push_back({wall, steady, std::move(heard)});
}

// The coordinator draws a way in the same steps: what is left out would have drawn nothing.
bool Digest::note(const wire::HelmetPose& pose, Place place) {
  KeptWay& way = ways_[{pose.agent_id, pose.map_id, pose.floor}];
  const Eigen::Vector2d here = pose.T_map_head.translation();
  if (!way.last_m || (here - *way.last_m).norm() >= Coordinator::kPathStepM) {
    way.last_m = here;
    return true;
  }
  way.recent.push_back(place);
  if (way.recent.size() <= kRecentPoses) return true;
  drop(way.recent.front());
  way.recent.pop_front();
  return true;
}

bool Digest::note(const wire::AgentStatus& status, Place place) {
  const auto [known, is_first] =
      statuses_.try_emplace({status.envelope.sender_id, status.envelope.incarnation}, place);
  if (!is_first) drop(std::exchange(known->second, place));
  return true;
}

bool Digest::note(const wire::TsdTile& tile, Place place) {
  KeptTile& kept = tiles_[{tile.layer, tile.tile_x, tile.tile_y}];
  if (tile.revision <= kept.whole_revision) return false;
  auto& parts = kept.parts[tile.revision];
  if (!parts.try_emplace(tile.part, place).second) return false;
  if (parts.size() < tile.parts) return true;
  kept.whole_revision = tile.revision;
  while (kept.parts.begin()->first < tile.revision) {
    for (const auto& [part, older] : kept.parts.begin()->second) drop(older);
    kept.parts.erase(kept.parts.begin());
  }
  return true;
}

}  // namespace lifeline
