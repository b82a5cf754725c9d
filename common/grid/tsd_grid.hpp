#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/grid/tile_index.hpp"
#include "common/grid/tsd_cell.hpp"

namespace lifeline {

/// What two grids must share to be compared or fused.
struct GridGeometry {
  double cell_size_m = 0.05;
  double truncation_m = 0.15;  ///< signed distances are cut off here
  bool operator==(const GridGeometry&) const = default;
};

/// A TSD grid without bounds, in tiles of 64 x 64 cells; memory grows with the tiles touched. One
/// owner, not thread-safe.
///
/// Frame: `map`. Cell (i, j) spans [i, i + 1) x [j, j + 1) cell sizes; its value stands for its
/// centre.
class TsdGrid {
 public:
  explicit TsdGrid(GridGeometry geometry = {}) : geometry_(geometry) {}

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

  /// The tile, or nullptr where nothing was ever written.
  [[nodiscard]] const TsdTile* find(TileIndex tile) const {
    const std::int64_t column = std::int64_t{tile.x} - first_.x,
                       row = std::int64_t{tile.y} - first_.y;
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
    return directory_[static_cast<std::size_t>(row * columns_ + column)].get();
  }

  /// The tile for writing, created empty where there was none. Marks nothing as changed. `tile`
  /// must be in range.
  [[nodiscard]] TsdTile& at(TileIndex tile);

  /// Forgets one tile, or all.
  void erase(TileIndex tile);
  void clear();

  /// The cell; unknown where no tile stands.
  [[nodiscard]] TsdCell cell(CellIndex index) const {
    const TsdTile* tile = find(tile_of(index));
    return tile == nullptr ? TsdCell{} : (*tile)[offset_in_tile(index)];
  }

  [[nodiscard]] CellIndex cell_at(const Eigen::Vector2d& p_map) const {
    return {static_cast<std::int32_t>(std::floor(p_map.x() / geometry_.cell_size_m)),
            static_cast<std::int32_t>(std::floor(p_map.y() / geometry_.cell_size_m))};
  }

  [[nodiscard]] Eigen::Vector2d centre_of(CellIndex index) const {
    return {(index.x + 0.5) * geometry_.cell_size_m, (index.y + 0.5) * geometry_.cell_size_m};
  }

  /// All tiles that exist, ordered by x, then y.
  [[nodiscard]] std::vector<TileIndex> tiles() const;
  [[nodiscard]] std::size_t tile_count() const { return count_; }

 private:
  void grow_to_hold(TileIndex tile);

  GridGeometry geometry_;
  TileIndex first_{};  ///< of the directory's lower left corner
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<std::unique_ptr<TsdTile>> directory_;
  std::size_t count_ = 0;
};

/// Known cells, in square metres: what a helmet has explored.
[[nodiscard]] double known_area_m2(const TsdGrid& grid);

/// A tile at the published precision.
[[nodiscard]] QuantisedTile quantise(const TsdTile& tile);
[[nodiscard]] TsdTile dequantise(const QuantisedTile& tile);

}  // namespace lifeline
