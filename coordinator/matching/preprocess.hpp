#pragma once

#include "common/grid/occupancy_grid.hpp"

namespace lifeline::matching {

/// The part of `grid` that is known, with a margin of `margin` unknown cells on each side. Empty
/// (0 x 0) when nothing is known.
[[nodiscard]] OccupancyGrid crop_to_known(const OccupancyGrid& grid, int margin);

/// The first two steps of section 3.2 of the paper. A cell gives way to the class of at least five
/// of its eight neighbours, but an occupied one only where its wall does not go on in two
/// neighbours; then the free neighbours of occupied cells become occupied too. Same size and frame
/// as `grid`.
[[nodiscard]] OccupancyGrid filter_noise(const OccupancyGrid& grid);

/// The last step: free cells beside unknown ones become occupied. It gives the spectra more to hold
/// on to, but such a border may be no wall but where a walk ended: agreement is counted without it.
[[nodiscard]] OccupancyGrid close_borders(const OccupancyGrid& grid);

/// All of section 3.2.
[[nodiscard]] OccupancyGrid preprocess(const OccupancyGrid& grid);

}  // namespace lifeline::matching
