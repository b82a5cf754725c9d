#include "coordinator/matching/preprocess.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace lifeline::matching {
namespace {

constexpr int kClasses = 3;

std::size_t as_index(Occupancy cell) {
  return static_cast<std::size_t>(cell);
}

std::array<std::ptrdiff_t, 4> four_around(const OccupancyGrid& grid) {
  const auto width = static_cast<std::ptrdiff_t>(grid.columns);
  return {-width, -1, 1, width};
}

/// Calls `visit(cell)` for each cell whose byte in `flags` (one row) is 1. memchr is far faster
/// than a loop, and few are.
template <typename Visit>
void for_flagged(std::span<const std::uint8_t> flags, Visit visit) {
  const std::uint8_t* at = flags.data();
  const std::uint8_t* const end = at + flags.size();
  while ((at = static_cast<const std::uint8_t*>(
              std::memchr(at, 1, static_cast<std::size_t>(end - at)))) != nullptr) {
    visit(at - flags.data());
    if (++at == end) return;
  }
}

/// Calls `visit(index)` for the cells that are of class `wanted` and have all eight neighbours.
template <typename Visit>
void for_inner_cells_of(const OccupancyGrid& grid, Occupancy wanted, Visit visit) {
  if (grid.columns < 3) return;
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(grid.columns) - 2);
  for (int row = 1; row + 1 < grid.rows; ++row) {
    const std::size_t first = grid.index(1, row);
    for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = grid.cells[first + i] == wanted;
    for_flagged(flags, [&](std::ptrdiff_t i) { visit(first + static_cast<std::size_t>(i)); });
  }
}

/// Calls `visit(index)` for the inner cells that differ from a neighbour in x or y: few do.
template <typename Visit>
void for_mixed_cells(const OccupancyGrid& grid, Visit visit) {
  if (grid.columns < 3) return;
  const auto width = static_cast<std::size_t>(grid.columns);
  std::vector<std::uint8_t> flags(width - 2);
  for (int row = 1; row + 1 < grid.rows; ++row) {
    const std::size_t first = grid.index(1, row);
    const Occupancy* const cell = grid.cells.data() + first;
    for (std::size_t i = 0; i < flags.size(); ++i) {
      flags[i] =
          static_cast<std::uint8_t>((cell[i] != (cell + i)[-1]) | (cell[i] != cell[i + 1]) |
                                    (cell[i] != (cell - width)[i]) | (cell[i] != cell[i + width]));
    }
    for_flagged(flags, [&](std::ptrdiff_t i) { visit(first + static_cast<std::size_t>(i)); });
  }
}

/// Whether `own` gives way to `most`, which `votes` of the eight neighbours are. A wall is thin: it
/// stays as long as it goes on in two neighbours.
bool gives_way(Occupancy own, int own_votes, int votes) {
  constexpr int kMajority = 5;
  return votes >= kMajority && (own != Occupancy::occupied || own_votes < 2);
}

OccupancyGrid vote(const OccupancyGrid& grid) {
  OccupancyGrid voted = grid;
  const auto width = static_cast<std::ptrdiff_t>(grid.columns);
  const std::array<std::ptrdiff_t, 8> around{-width - 1, -width,    -width + 1, -1,
                                             1,          width - 1, width,      width + 1};
  // A cell whose four nearest are like it has no majority against it.
  for_mixed_cells(grid, [&](std::size_t at) {
    const Occupancy own = grid.cells[at];
    const Occupancy* cell = &grid.cells[at];
    std::array<int, kClasses> votes{};
    for (const std::ptrdiff_t step : around) ++votes[as_index(cell[step])];
    const auto most = std::max_element(votes.begin(), votes.end());
    if (gives_way(own, votes[as_index(own)], *most)) {
      voted.cells[at] = static_cast<Occupancy>(most - votes.begin());
    }
  });
  return voted;
}

OccupancyGrid augment(const OccupancyGrid& grid) {
  OccupancyGrid augmented = grid;
  const auto around = four_around(grid);
  for_inner_cells_of(grid, Occupancy::occupied, [&](std::size_t at) {
    Occupancy* cell = &augmented.cells[at];
    for (const std::ptrdiff_t step : around) {
      if (cell[step] == Occupancy::free) cell[step] = Occupancy::occupied;
    }
  });
  return augmented;
}

}  // namespace

OccupancyGrid crop_to_known(const OccupancyGrid& grid, int margin) {
  int left = grid.columns, right = -1, bottom = grid.rows, top = -1;
  for (int row = 0; row < grid.rows; ++row) {
    const auto begin = grid.cells.begin() + static_cast<std::ptrdiff_t>(grid.index(0, row));
    const auto end = begin + grid.columns;
    const auto known = [](Occupancy cell) { return cell != Occupancy::unknown; };
    const auto first = std::find_if(begin, end, known);
    if (first == end) continue;
    const auto last = std::find_if(std::reverse_iterator(end), std::reverse_iterator(first), known);
    left = std::min(left, static_cast<int>(first - begin));
    right = std::max(right, static_cast<int>(last.base() - begin) - 1);
    bottom = std::min(bottom, row);
    top = row;
  }
  OccupancyGrid cropped;
  cropped.cell_size_m = grid.cell_size_m;
  cropped.origin_m = grid.origin_m;
  if (right < 0) return cropped;
  cropped.columns = right - left + 1 + 2 * margin;
  cropped.rows = top - bottom + 1 + 2 * margin;
  cropped.origin_m += grid.cell_size_m * Eigen::Vector2d(left - margin, bottom - margin);
  cropped.cells.assign(
      static_cast<std::size_t>(cropped.columns) * static_cast<std::size_t>(cropped.rows),
      Occupancy::unknown);
  for (int row = bottom; row <= top; ++row) {
    const auto from = grid.cells.begin() + static_cast<std::ptrdiff_t>(grid.index(left, row));
    std::copy(from, from + (right - left + 1),
              cropped.cells.begin() +
                  static_cast<std::ptrdiff_t>(cropped.index(margin, row - bottom + margin)));
  }
  return cropped;
}

OccupancyGrid filter_noise(const OccupancyGrid& grid) {
  return augment(vote(grid));
}

OccupancyGrid close_borders(const OccupancyGrid& grid) {
  OccupancyGrid closed = grid;
  const auto around = four_around(grid);
  for_mixed_cells(grid, [&](std::size_t at) {
    const Occupancy* cell = &grid.cells[at];
    if (*cell != Occupancy::free) return;
    const bool at_border = std::any_of(around.begin(), around.end(), [&](std::ptrdiff_t step) {
      return cell[step] == Occupancy::unknown;
    });
    if (at_border) closed.cells[at] = Occupancy::occupied;
  });
  return closed;
}

OccupancyGrid preprocess(const OccupancyGrid& grid) {
  return close_borders(filter_noise(grid));
}

}  // namespace lifeline::matching
