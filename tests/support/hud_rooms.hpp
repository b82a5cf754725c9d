#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "agents/hud/hud_map.hpp"

namespace lifeline::test {

/// The tiles of a flawless map between two corners (metres): `cell(p)` says for each cell's middle
/// what is there.
inline sharing::MapTiles drawn_tiles(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m,
                                     const std::function<Occupancy(const Eigen::Vector2d&)>& cell,
                                     double cell_size_m = 0.05) {
  sharing::MapTiles tiles;
  const TileIndex first = tile_of(hud::cell_at(low_m, cell_size_m));
  const TileIndex last = tile_of(hud::cell_at(high_m, cell_size_m));
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      auto cells = std::make_shared<QuantisedTile>();
      const CellIndex corner = first_cell({x, y});
      for (std::size_t i = 0; i < cells->size(); ++i) {
        const auto column = static_cast<int>(i % kTileSide), row = static_cast<int>(i / kTileSide);
        const Eigen::Vector2d p_m =
            Eigen::Vector2d(corner.x + column + 0.5, corner.y + row + 0.5) * cell_size_m;
        const Occupancy what = cell(p_m);
        // On a wall the signed distance is 0.
        if (what != Occupancy::unknown)
          (*cells)[i] = {static_cast<std::int8_t>(what == Occupancy::free ? 100 : 0), 4};
      }
      tiles.emplace_back(TileIndex{x, y}, std::move(cells));
    }
  }
  return tiles;
}

/// A plan as text, north at its first line: '#' wall, '.' free, ' ' unknown; each character is a
/// square of `side_m`, the lower left one at the origin.
inline sharing::MapTiles plan_tiles(const std::vector<std::string>& plan, double side_m = 0.5) {
  const auto rows = static_cast<int>(plan.size());
  const double width_m = side_m * static_cast<double>(plan.front().size()),
               height_m = side_m * rows;
  return drawn_tiles({0.0, 0.0}, {width_m, height_m}, [&](const Eigen::Vector2d& p_m) {
    const int column = static_cast<int>(std::floor(p_m.x() / side_m));
    const int row = rows - 1 - static_cast<int>(std::floor(p_m.y() / side_m));
    if (row < 0 || row >= rows || column < 0 ||
        column >= static_cast<int>(plan[static_cast<std::size_t>(row)].size())) {
      return Occupancy::unknown;
    }
    const char what = plan[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return what == '#' ? Occupancy::occupied : what == '.' ? Occupancy::free : Occupancy::unknown;
  });
}

}  // namespace lifeline::test
