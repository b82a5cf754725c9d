#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/grid/tsd_grid.hpp"

namespace lifeline::slam {

/// What a helmet matches against: its own layer blended with its peers' cells by Eq. 8-10, in its
/// own map frame. The own layer is never changed by the blend. Blended tiles are made when they are
/// looked at and kept until a side of them changes; without peers a look costs one comparison more
/// than at the layer itself. One owner, not thread-safe.
class WorkingMap {
 public:
  explicit WorkingMap(GridGeometry geometry) : own_(geometry) {}

  [[nodiscard]] const GridGeometry& geometry() const { return own_.geometry(); }
  [[nodiscard]] const TsdGrid& own() const { return own_; }

  /// The own layer for writing; tell note_own_changed() which tiles were written.
  [[nodiscard]] TsdGrid& own() { return own_; }
  void note_own_changed(std::span<const TileIndex> tiles);

  /// The peers' cells of one tile, in this map's frame; nullptr takes them away.
  void set_peer_tile(TileIndex tile, std::shared_ptr<const TsdTile> cells);
  void clear_peers();
  [[nodiscard]] bool has_peers() const { return !peers_.empty(); }

  /// w_T1 of Eq. 8-10, in [0, 1]; 0.5 at first.
  void set_own_weight(double w_T1);

  /// All tiles that either side has, ordered by x, then y.
  [[nodiscard]] std::vector<TileIndex> tiles() const;

  /// The blended tile; nullptr where neither side has one. Valid until the next change.
  [[nodiscard]] const TsdTile* find(TileIndex tile) const;

 private:
  struct PeerTile {
    std::shared_ptr<const TsdTile> cells;
    mutable std::unique_ptr<TsdTile> blended;
    mutable bool stale = true;
  };

  TsdGrid own_;
  double own_weight_ = 0.5;
  std::unordered_map<TileIndex, PeerTile> peers_;
};

/// Eq. 8-10 for one cell: w_T1 of the own distance and 1 - w_T1 of the peer's where both are known,
/// else the one that is.
[[nodiscard]] TsdCell blended(TsdCell own, TsdCell peer, double w_T1);

}  // namespace lifeline::slam
