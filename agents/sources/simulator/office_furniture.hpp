#pragma once

#include <vector>

#include "agents/sources/simulator/office_layout.hpp"

namespace lifeline::sources {

/// What stands in the rooms and is as high as a head: cupboards along the walls, shelves, pillars.
struct OfficeFurniture {
  std::vector<Box> boxes;  ///< along the axes; may touch a wall
  std::vector<WallSegment>
      loops;  ///< slanted or round, clear of walls and boxes, floor to the left
};

/// Furnishes every room. Doorways stay clear, and between any two pieces, or a free-standing piece
/// and a wall, at least 0.9 m is left: no piece of floor is cut off.
[[nodiscard]] OfficeFurniture furnish_office(const OfficeLayout& layout, Draw& draw);

}  // namespace lifeline::sources
