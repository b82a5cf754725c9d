#pragma once

#include <cstdint>
#include <cstring>

#include "common/grid/occupancy_grid.hpp"

namespace lifeline::matching {

static_assert(sizeof(Occupancy) == 1 && Occupancy::unknown == Occupancy{0});

/// Calls visit(column) for the cells of a row that are known, skipping eight unknown ones at a
/// time: most of a map is unknown.
template <typename Visit>
void for_known_cells(const Occupancy* row, int columns, Visit visit) {
  constexpr int kAtOnce = sizeof(std::uint64_t);
  for (int column = 0; column < columns;) {
    std::uint64_t next = 1;
    if (column + kAtOnce <= columns) std::memcpy(&next, row + column, sizeof(next));
    if (next == 0) {
      column += kAtOnce;
      continue;
    }
    if (row[column] != Occupancy::unknown) visit(column);
    ++column;
  }
}

}  // namespace lifeline::matching
