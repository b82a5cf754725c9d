#pragma once

#include <array>

#include "common/grid/tsd_cell.hpp"

namespace lifeline::wire {

/// The distances and weights that a coarse cell may have (idl/tile.proto, version 2).
inline constexpr std::array<int, 5> kCoarseLevels = {-32, -10, 10, 32, QuantisedCell::kTsdOne};
inline constexpr int kThin = 1, kWellSeen = 6;

/// Whether all cells hold values of the coarse set.
[[nodiscard]] bool is_coarse(const QuantisedTile& tile);

/// The tile in coarse values: the same cells are known. `held` is what others hold of it, or
/// nullptr: a cell keeps its value there while the tile's own lies close by, so that what flickers
/// between two values is not sent again and again (docs/decisions/0109).
///
/// Without `held` no cell changes its side of the surface (a tsd of 0 counts as behind it); with it
/// one may keep a side that the tile left by no more than 5 / 127 of the truncation distance. What
/// coarse() gave for a tile, `held`, comes out again.
[[nodiscard]] QuantisedTile coarse(const QuantisedTile& tile, const QuantisedTile* held = nullptr);

}  // namespace lifeline::wire
