#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/base/result.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline {

enum class Occupancy : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

/// A dense occupancy grid. Cell (column, row) has its lower left corner at origin + (column, row) *
/// cell_size_m; rows go up.
struct OccupancyGrid {
  double cell_size_m = 0.05;
  Eigen::Vector2d origin_m{0.0, 0.0};  ///< lower left corner in the map's frame
  int columns = 0;
  int rows = 0;
  std::vector<Occupancy> cells;  ///< columns * rows, row by row from below

  [[nodiscard]] bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }
  /// Unknown outside of the grid.
  [[nodiscard]] Occupancy at(int column, int row) const {
    return contains(column, row) ? cells[index(column, row)] : Occupancy::unknown;
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// The largest dense grid that is made of a map (1 km a side at 5 cm, 100 MB). Tiles come from
/// peers: two of them far apart would ask for gigabytes.
inline constexpr int kMaxCellsPerSide = 20'000;
inline constexpr std::int64_t kMaxGridCells = 100'000'000;

/// Error (unsupported) where a grid of this size would be too large.
[[nodiscard]] Result<void> check_grid_size(std::int64_t columns, std::int64_t rows);

/// Eq. 6: occupied where the TSD changes its sign to a neighbour in x or y, else free where it is
/// positive, else unknown. The grid covers all tiles of `tsd`, in its frame. A cell that is exactly
/// 0 lies on a surface and counts as occupied. Error (unsupported) where the tiles lie too far
/// apart for one dense grid (check_grid_size).
[[nodiscard]] Result<OccupancyGrid> to_occupancy(const TsdGrid& tsd);

/// How many cells are free or occupied: the sum of Eq. 11.
[[nodiscard]] std::size_t known_cells(const OccupancyGrid& grid);
/// The same of a map, by Eq. 6, however far apart its tiles lie.
[[nodiscard]] std::size_t known_cells(const TsdGrid& tsd);

}  // namespace lifeline
