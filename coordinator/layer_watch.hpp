#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include <Eigen/Geometry>

#include "common/grid/tsd_cell.hpp"
#include "common/sharing/replica_store.hpp"

namespace lifeline {

/// What became of one layer's walls, tile by tile: a map that grows adds walls, a map that its
/// helmet corrected has them elsewhere. One owner, not thread-safe.
class LayerWatch {
 public:
  /// A tile as it stands now.
  void note(TileIndex tile, std::shared_ptr<const QuantisedTile> cells);

  /// Known cells within the truncation distance of a wall.
  [[nodiscard]] std::size_t wall_cells() const { return wall_cells_; }
  /// Such cells that a later tile contradicted so far: moved by more than a third of the truncation
  /// distance, or forgotten; not those that are well in front of a wall before and after. Never
  /// decreases.
  [[nodiscard]] std::size_t revised_cells() const { return revised_cells_; }
  /// The box round all known cells, map frame, metres; empty without any.
  [[nodiscard]] Eigen::AlignedBox2d extent(double cell_size_m) const;

 private:
  struct Seen {
    std::shared_ptr<const QuantisedTile> cells;
    std::size_t wall_cells = 0;
    Eigen::AlignedBox2i known;  ///< indices of known cells, in the map
  };
  std::map<TileIndex, Seen> tiles_;
  std::size_t wall_cells_ = 0;
  std::size_t revised_cells_ = 0;
};

}  // namespace lifeline
