#pragma once

#include <cstdint>
#include <vector>

#include "common/search/search_cells.hpp"

namespace lifeline::search {

/// Where what is known ends: frontier squares that touch each other (corners count), within one
/// square of the map of kPartTiles tiles a side. A long edge is thus several parts, and several
/// helmets may go to it.
struct Part {
  std::vector<CellId> cells;
};
inline constexpr int kPartTiles = 2;
/// What is shorter is a gap between beams, not a way on.
inline constexpr std::size_t kLeastCells = 3;
/// What lies behind must be larger than this many squares, 0.5 m2 at cells of 0.05 m: the inside of
/// a table or a pillar, which no beam reached, has no room for a person who lies there.
inline constexpr std::size_t kLeastUnknown = 13;

inline constexpr std::uint32_t kNoPart = ~std::uint32_t{0};

struct Parts {
  std::vector<Part> parts;             ///< by their lowest square: x, then y
  std::vector<std::uint32_t> part_of;  ///< of each square; kNoPart
};

/// The same whatever the order in which the tiles came.
[[nodiscard]] Parts find_parts(SearchCells& cells);

/// A part as lines to draw, in the map's frame: its squares' middles, each after its nearest.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> outline_m(const Part& part,
                                                                  const SearchCells& cells);

}  // namespace lifeline::search
