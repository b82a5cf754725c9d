#include "common/search/find_seekers.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline::search {

std::vector<Seeker> find_seekers(const sharing::PoseWatch& poses, const sharing::Roster& roster,
                                 const std::vector<sharing::Placement>& placements,
                                 SteadyTime now) {
  std::vector<Seeker> seekers;
  for (const auto& [id, entry] : poses.entries()) {
    const auto layer = sharing::to_layer_key({id, entry.pose.map_id, entry.pose.floor});
    const auto* known = roster.find(id);
    if (!layer || known == nullptr) continue;
    if (sharing::Roster::presence(*known, now) == sharing::Presence::lost ||
        known->status.state == wire::AgentState::lost)
      continue;
    const auto place = std::ranges::find(placements, *layer, &sharing::Placement::layer);
    if (place == placements.end()) continue;
    seekers.push_back(
        {id, sharing::to_pose(place->T_fused_layer) * entry.pose.T_map_head.translation()});
  }
  return seekers;
}

}  // namespace lifeline::search
