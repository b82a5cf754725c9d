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

}  // namespace

OccupancyGrid to_occupancy(const TsdGrid& tsd) {
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
  grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                    Occupancy::unknown);
  for (const TileIndex tile : tiles) {
    const CellIndex first = first_cell(tile);
    for (int y = first.y; y < first.y + kTileSide; ++y) {
      for (int x = first.x; x < first.x + kTileSide; ++x) {
        grid.cells[grid.index(x - corner.x, y - corner.y)] = classify(tsd, {x, y});
      }
    }
  }
  return grid;
}

std::size_t known_cells(const OccupancyGrid& grid) {
  return static_cast<std::size_t>(
      std::count_if(grid.cells.begin(), grid.cells.end(),
                    [](Occupancy cell) { return cell != Occupancy::unknown; }));
}

}  // namespace lifeline
