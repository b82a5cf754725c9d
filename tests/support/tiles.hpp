#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "common/grid/tsd_cell.hpp"

namespace lifeline::support {

/// A tile of a map: a straight wall at `angle_rad` through the middle, free in front of it, unknown
/// far behind, seen better on the right. Distances in cells of 0.05 m, truncation three cells.
[[nodiscard]] inline QuantisedTile wall_tile(double angle_rad, double offset_cells = 0.0) {
  QuantisedTile tile{};
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const double distance =
          (x - 31.5) * std::cos(angle_rad) + (y - 31.5) * std::sin(angle_rad) - offset_cells;
      if (distance < -3.0) continue;
      auto& cell = tile[offset_in_tile({x, y})];
      cell.weight = static_cast<std::uint8_t>(1 + x / 5);
      cell.tsd = static_cast<std::int8_t>(
          std::lround(std::min(1.0, distance / 3.0) * QuantisedCell::kTsdOne));
    }
  }
  return tile;
}

/// Any valid tile: each cell known with probability `known`, whatever its neighbours are.
[[nodiscard]] inline QuantisedTile random_tile(std::mt19937& random, double known) {
  std::bernoulli_distribution is_known(known);
  std::uniform_int_distribution<int> tsd(-QuantisedCell::kTsdOne, QuantisedCell::kTsdOne);
  std::uniform_int_distribution<int> weight(1, QuantisedCell::kMaxWeight);
  QuantisedTile tile{};
  for (auto& cell : tile) {
    if (!is_known(random)) continue;
    cell = {static_cast<std::int8_t>(tsd(random)), static_cast<std::uint8_t>(weight(random))};
  }
  return tile;
}

}  // namespace lifeline::support
