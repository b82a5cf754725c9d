#pragma once

#include <map>
#include <set>
#include <vector>

#include "common/base/sha256.hpp"
#include "common/sharing/fuse_tile.hpp"

namespace lifeline::sharing {

/// A member of a fused map by name.
struct Placement {
  LayerKey layer;
  wire::FixedTransform T_fused_layer;
  bool operator==(const Placement&) const = default;
};

/// A map fused from several layers, kept up to date tile by tile: the common map (all members,
/// common frame), or the peers' part of a helmet's working map (all others, own frame). A pure
/// function of (placements, layers): a corrected or withdrawn placement leaves no trace. One owner,
/// not thread-safe.
class FusedMap {
 public:
  explicit FusedMap(GridGeometry geometry);

  /// Replaces the members. Everything is fused anew at the next update, unless nothing changed.
  void place(std::vector<Placement> placements, const ReplicaStore& store);

  /// A tile of a layer changed.
  void mark(const ReplicaStore::ChangedTile& changed);

  /// Fuses what was marked; answers the tiles whose cells changed or that vanished.
  std::vector<TileIndex> update(const ReplicaStore& store);

  /// Nothing that was marked or placed waits for an update.
  [[nodiscard]] bool is_up_to_date() const { return marked_.empty(); }

  [[nodiscard]] const std::map<TileIndex, FusedTile>& tiles() const { return tiles_; }
  [[nodiscard]] const std::vector<Placement>& placements() const { return placements_; }

  /// SHA-256 over all tiles in order: index, then each cell's tsd and weight.
  [[nodiscard]] Sha256Digest sha256() const;

  /// The map as a TSD grid (weights capped to the published range), for drawing and export.
  [[nodiscard]] TsdGrid to_grid() const;

 private:
  GridGeometry geometry_;
  std::int64_t cell_size_um_;
  std::vector<Placement> placements_;  // ordered by layer
  std::map<TileIndex, FusedTile> tiles_;
  std::set<TileIndex> marked_;
};

/// A fused tile as matching reads it.
[[nodiscard]] TsdTile to_tsd_tile(const FusedTile& tile);

}  // namespace lifeline::sharing
