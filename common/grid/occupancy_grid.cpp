#include "common/grid/occupancy_grid.hpp"

#include <algorithm>

namespace lifeline {
namespace {

bool changes_sign(TsdCell cell, TsdCell neighbour) {
  return neighbour.known() && std::int32_t{cell.tsd} * neighbour.tsd < 0;
}

Occupancy classify(const TsdGrid& tsd, CellIndex i) {
  const TsdCell cell = tsd.cell(i);
  if (!cell.known()) return Occupancy::unknown;
  if (cell.tsd == 0 || changes_sign(cell, tsd.cell({i.x + 1, i.y})) ||
      changes_sign(cell, tsd.cell({i.x - 1, i.y})) ||
      changes_sign(cell, tsd.cell({i.x, i.y + 1})) ||
      changes_sign(cell, tsd.cell({i.x, i.y - 1}))) {
    return Occupancy::occupied;
  }
  return cell.tsd > 0 ? Occupancy::free : Occupancy::unknown;
}

/// Calls use(index, occupancy) for each cell of a tile.
template <typename Use>
void each_cell(const TsdGrid& tsd, TileIndex tile, Use&& use) {
  const CellIndex first = first_cell(tile);
  for (int y = first.y; y < first.y + kTileSide; ++y) {
    for (int x = first.x; x < first.x + kTileSide; ++x) use(CellIndex{x, y}, classify(tsd, {x, y}));
  }
}

}  // namespace

Result<void> check_grid_size(std::int64_t columns, std::int64_t rows) {
  if (columns <= kMaxCellsPerSide && rows <= kMaxCellsPerSide && columns * rows <= kMaxGridCells)
    return {};
  return fail(ErrorCode::unsupported,
              "the map has {} x {} cells: a grid has at most {} a side and {} million in all",
              columns, rows, kMaxCellsPerSide, kMaxGridCells / 1'000'000);
}

Result<OccupancyGrid> to_occupancy(const TsdGrid& tsd) {
  OccupancyGrid grid;
  grid.cell_size_m = tsd.geometry().cell_size_m;
  const auto tiles = tsd.tiles();
  if (tiles.empty()) return grid;
  const auto [low_x, high_x] = std::minmax_element(
      tiles.begin(), tiles.end(), [](TileIndex a, TileIndex b) { return a.x < b.x; });
  const auto [low_y, high_y] = std::minmax_element(
      tiles.begin(), tiles.end(), [](TileIndex a, TileIndex b) { return a.y < b.y; });
  const CellIndex corner = first_cell({low_x->x, low_y->y});
  grid.origin_m = Eigen::Vector2d(corner.x, corner.y) * grid.cell_size_m;
  grid.columns = (high_x->x - low_x->x + 1) * kTileSide;
  grid.rows = (high_y->y - low_y->y + 1) * kTileSide;
  if (auto size = check_grid_size(grid.columns, grid.rows); !size) return forward_error(size);
  grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                    Occupancy::unknown);
  for (const TileIndex tile : tiles) {
    each_cell(tsd, tile, [&](CellIndex i, Occupancy occupancy) {
      grid.cells[grid.index(i.x - corner.x, i.y - corner.y)] = occupancy;
    });
  }
  return grid;
}

std::size_t known_cells(const OccupancyGrid& grid) {
  return static_cast<std::size_t>(
      std::count_if(grid.cells.begin(), grid.cells.end(),
                    [](Occupancy cell) { return cell != Occupancy::unknown; }));
}

std::size_t known_cells(const TsdGrid& tsd) {
  std::size_t known = 0;
  for (const TileIndex tile : tsd.tiles()) {
    each_cell(tsd, tile, [&](CellIndex, Occupancy occupancy) {
      known += occupancy != Occupancy::unknown ? 1U : 0U;
    });
  }
  return known;
}

}  // namespace lifeline
