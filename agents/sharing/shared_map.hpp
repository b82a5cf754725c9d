#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sharing/fused_map.hpp"

namespace lifeline::sharing {

/// What changed in the peers' part of the working map, in the helmet's own map frame.
struct PeerUpdate {
  std::vector<std::pair<TileIndex, std::shared_ptr<const TsdTile>>>
      tiles;                ///< nullptr: the tile is gone
  double own_weight = 0.5;  ///< w_T1 of Eq. 8-10
};

/// A helmet's view of what is shared: everybody's layers, the directive in force, the common map
/// that both make, and the peers' part of the working map (Eq. 8-10). One owner, not thread-safe.
class SharedMap {
 public:
  SharedMap(LayerKey own_layer, GridGeometry geometry);

  /// Takes a directive whose envelope was accepted. False: not newer than the one in force. An
  /// error changes nothing.
  [[nodiscard]] Result<bool> follow(const wire::MergeDirective& directive);

  [[nodiscard]] ReplicaStore& store() { return store_; }
  [[nodiscard]] const ReplicaStore& store() const { return store_; }

  /// Brings both maps up to date with layers and directive.
  void update();
  /// Takes note of what an update will have to do.
  void mark_changes();

  /// Hears of each tile, once it is in the common map, that was taken in since the last update().
  using FusedListener = std::function<void(const LayerKey&, TileIndex, Revision)>;
  void set_fused_listener(FusedListener listener) { fused_listener_ = std::move(listener); }

  /// Hears of each tile of the common map whose cells changed or that vanished.
  using MapListener = std::function<void(TileIndex)>;
  void set_map_listener(MapListener listener) { map_listener_ = std::move(listener); }

  /// Changes of the peers' part since the last call, if any.
  [[nodiscard]] std::optional<PeerUpdate> take_peer_update();

  [[nodiscard]] Epoch epoch() const { return {directive_.epoch}; }
  /// The directive in force; epoch 0 before the first.
  [[nodiscard]] const wire::MergeDirective& directive() const { return directive_; }
  [[nodiscard]] const FusedMap& common_map() const { return common_map_; }
  /// Of epoch and members' revision vectors; all zero while there is no common map.
  [[nodiscard]] RevisionDigest fingerprint() const;
  /// All zero while there is no common map, or it is behind layers and directive.
  [[nodiscard]] Sha256Digest common_map_sha256() const;
  [[nodiscard]] bool shares() const { return !common_map_.placements().empty(); }

 private:
  void place(const wire::MergeDirective& directive);
  void tell_fused(const std::vector<ReplicaStore::ChangedTile>& changed) const;

  LayerKey own_layer_;
  ReplicaStore store_;
  FusedMap common_map_;
  FusedMap peers_map_;
  wire::MergeDirective directive_;
  double own_weight_ = 0.5;
  std::vector<ReplicaStore::ChangedTile> taken_in_;  ///< since the last update
  FusedListener fused_listener_;
  MapListener map_listener_;
  std::vector<TileIndex> changed_peer_tiles_;
};

}  // namespace lifeline::sharing
