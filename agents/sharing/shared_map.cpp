#include "agents/sharing/shared_map.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "common/sharing/groups.hpp"

namespace lifeline::sharing {

SharedMap::SharedMap(LayerKey own_layer, GridGeometry geometry)
    : own_layer_(std::move(own_layer)),
      store_(geometry),
      common_map_(geometry),
      peers_map_(geometry) {}

Result<bool> SharedMap::follow(const wire::MergeDirective& directive) {
  if (auto sound = check_directive(directive); !sound) return forward_error(sound);
  if (directive.epoch == 0 || !outranks(directive, directive_)) return false;
  directive_ = directive;
  own_weight_ = directive.own_weight_permille / 1000.0;
  place(directive);
  return true;
}

void SharedMap::place(const wire::MergeDirective& directive) {
  auto members = group_of(directive, own_layer_);
  std::vector<Placement> peers;
  Pose2 T_own_common;
  for (const auto& member : members) {
    if (member.layer == own_layer_) T_own_common = to_pose(member.T_fused_layer).inverse();
  }
  for (const auto& member : members) {
    if (member.layer == own_layer_) continue;
    // For matching only, so a transform that this machine rounded itself does no harm.
    peers.push_back({member.layer, to_fixed(T_own_common * to_pose(member.T_fused_layer))});
  }
  common_map_.place(std::move(members), store_);
  peers_map_.place(std::move(peers), store_);
}

void SharedMap::mark_changes() {
  for (auto& changed : store_.take_changed()) {
    common_map_.mark(changed);
    peers_map_.mark(changed);
    taken_in_.push_back(std::move(changed));
  }
}

void SharedMap::update() {
  mark_changes();
  for (const TileIndex tile : common_map_.update(store_)) {
    if (map_listener_) map_listener_(tile);
  }
  if (fused_listener_) tell_fused(taken_in_);
  taken_in_.clear();
  const auto changed = peers_map_.update(store_);
  changed_peer_tiles_.insert(changed_peer_tiles_.end(), changed.begin(), changed.end());
}

void SharedMap::tell_fused(const std::vector<ReplicaStore::ChangedTile>& changed) const {
  for (const auto& [layer, tile] : changed) {
    const auto& members = common_map_.placements();
    if (std::ranges::find(members, layer, &Placement::layer) == members.end()) continue;
    fused_listener_(layer, tile, store_.find(layer)->at(tile).revision);
  }
}

std::optional<PeerUpdate> SharedMap::take_peer_update() {
  if (changed_peer_tiles_.empty()) return std::nullopt;
  PeerUpdate update;
  update.own_weight = own_weight_;
  std::sort(changed_peer_tiles_.begin(), changed_peer_tiles_.end());
  changed_peer_tiles_.erase(std::unique(changed_peer_tiles_.begin(), changed_peer_tiles_.end()),
                            changed_peer_tiles_.end());
  for (const TileIndex tile : changed_peer_tiles_) {
    const auto cells = peers_map_.tiles().find(tile);
    update.tiles.emplace_back(tile,
                              cells == peers_map_.tiles().end()
                                  ? nullptr
                                  : std::make_shared<const TsdTile>(to_tsd_tile(cells->second)));
  }
  changed_peer_tiles_.clear();
  return update;
}

RevisionDigest SharedMap::fingerprint() const {
  if (!shares()) return {};
  std::vector<LayerKey> members;
  for (const auto& placement : common_map_.placements()) members.push_back(placement.layer);
  return sharing::fingerprint(epoch(), members, store_);
}

Sha256Digest SharedMap::common_map_sha256() const {
  return shares() && common_map_.is_up_to_date() ? common_map_.sha256() : Sha256Digest{};
}

}  // namespace lifeline::sharing
