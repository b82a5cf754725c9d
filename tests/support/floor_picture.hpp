#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/grid/tile_index.hpp"
#include "common/search/search_cells.hpp"
#include "common/sharing/fuse_tile.hpp"

namespace lifeline::test {

/// A map drawn in squares of search::kFine cells: '.' free, '#' wall, anything else unknown. The
/// first line is the top; the last line's first square lies at `low_left`.
class FloorPicture {
 public:
  explicit FloorPicture(const std::vector<std::string>& lines, CellIndex low_left = {0, 0}) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t x = 0; x < lines[i].size(); ++x) {
        set({low_left.x + static_cast<int>(x), low_left.y + static_cast<int>(lines.size() - 1 - i)},
            lines[i][x]);
      }
    }
  }
  FloorPicture() = default;

  void set(CellIndex square, char what) {
    for (int y = 0; y < search::kFine; ++y) {
      for (int x = 0; x < search::kFine; ++x) {
        const CellIndex cell{square.x * search::kFine + x, square.y * search::kFine + y};
        auto& at = tiles_[tile_of(cell)][offset_in_tile(cell)];
        at = {};
        if (what == '.') at = {100, 5};
        if (what == '#') at = {-20, 5};
      }
    }
  }

  [[nodiscard]] const std::map<TileIndex, sharing::FusedTile>& tiles() const { return tiles_; }

  /// Puts every tile into something that takes them.
  template <typename Taker>
  void put_into(Taker& taker) const {
    for (const auto& [tile, cells] : tiles_) taker.put(tile, &cells);
  }

 private:
  std::map<TileIndex, sharing::FusedTile> tiles_;
};

}  // namespace lifeline::test
