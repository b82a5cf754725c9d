#include "coordinator/settlement.hpp"

#include <algorithm>
#include <vector>

#include "common/sharing/accept.hpp"

namespace lifeline {
namespace {

std::vector<const wire::AgentStatus*> helmets_of(const sharing::Roster& roster) {
  std::vector<const wire::AgentStatus*> helmets;
  for (const auto& [id, entry] : roster.entries()) {
    if (entry.status.role == wire::Role::helmet) helmets.push_back(&entry.status);
  }
  return helmets;
}

bool holds_what_we_hold(const wire::AgentStatus& helmet, const sharing::ReplicaStore& store) {
  return helmet.layers.size() == store.layers().size() &&
         std::all_of(
             helmet.layers.begin(), helmet.layers.end(), [&](const wire::LayerDigest& held) {
               const auto key = sharing::to_layer_key(held.layer);
               return key && store.find(*key) != nullptr && store.digest(*key) == held.revisions;
             });
}

}  // namespace

std::string_view to_string(Settlement settlement) {
  switch (settlement) {
    case Settlement::working:
      return "working";
    case Settlement::apart:
      return "apart";
    case Settlement::shared:
      return "shared";
  }
  return "?";
}

Settlement settlement(const Coordinator& coordinator, std::size_t helmets) {
  const auto statuses = helmets_of(coordinator.roster());
  if (statuses.size() < helmets || !coordinator.idle()) return Settlement::working;
  for (const auto* helmet : statuses) {
    if (helmet->state != wire::AgentState::finished || helmet->tiles_behind > 0 ||
        !holds_what_we_hold(*helmet, coordinator.store()) ||
        helmet->epoch_applied != coordinator.directive().epoch) {
      return Settlement::working;
    }
  }
  const auto own = coordinator.status();
  const auto& members = coordinator.common_map().placements();
  for (const auto* helmet : statuses) {
    const bool member = std::any_of(members.begin(), members.end(), [&](const auto& placement) {
      return placement.layer.agent_id.text() == helmet->agent_id;
    });
    if (!member) return Settlement::apart;
    if (own.common_map_sha256 == Sha256Digest{} || helmet->fingerprint != own.fingerprint ||
        helmet->common_map_sha256 != own.common_map_sha256) {
      return Settlement::working;
    }
  }
  return Settlement::shared;
}

}  // namespace lifeline
