#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "common/grid/tile_index.hpp"
#include "common/sharing/fuse_tile.hpp"

namespace lifeline::search {

/// What a person who searches makes of a place.
enum class Cover : std::uint8_t {
  unknown,  ///< nobody saw it
  free,     ///< seen, and one can stand there
  wall,
};

/// A square of kFine x kFine cells of a map, 0.2 m a side at cells of 0.05 m: a door is some of
/// them wide.
using CellId = std::uint32_t;
inline constexpr CellId kNoCell = ~CellId{0};
inline constexpr int kFine = 4;
inline constexpr int kBlockSide = kTileSide / kFine;  ///< squares along one side of a tile
inline constexpr int kBlockCells = kBlockSide * kBlockSide;

/// A map in such squares, tile by tile. A square is wall where one of its cells is on or behind a
/// surface, else free where at least half of them are, else unknown. Frontier is a free square with
/// an unknown one beside it. One owner, not thread-safe.
class SearchCells {
 public:
  explicit SearchCells(double map_cell_m) : cell_m_(map_cell_m * kFine) {}

  /// A tile of the map as it is now; nullptr: it is no more.
  void put(TileIndex tile, const sharing::FusedTile* cells);

  [[nodiscard]] double cell_m() const { return cell_m_; }
  /// One more than the largest id.
  [[nodiscard]] std::size_t size() const { return cover_.size(); }
  [[nodiscard]] Cover at(CellId cell) const {
    return cell == kNoCell ? Cover::unknown : cover_[cell];
  }
  /// The square at this place, counted in squares; kNoCell outside of all tiles.
  [[nodiscard]] CellId find(CellIndex place) const;
  [[nodiscard]] CellIndex place(CellId cell) const;
  /// Its middle, in the map's frame.
  [[nodiscard]] Eigen::Vector2d centre_m(CellId cell) const;
  /// Right, up, left, down: 0 to 3. kNoCell where no tile is.
  [[nodiscard]] CellId neighbour(CellId cell, int direction) const;
  /// All frontier squares, tile by tile in the order in which the tiles came.
  [[nodiscard]] std::vector<CellId> frontier();

 private:
  struct Block {
    TileIndex tile;
    std::array<std::uint32_t, 4> beside;  ///< blocks; kNoCell: none
    std::vector<CellId> frontier;
    bool is_old = true;  ///< frontier is to be found anew
  };
  [[nodiscard]] std::uint32_t block_of(TileIndex tile);
  void find_frontier(std::uint32_t block);

  double cell_m_;
  std::unordered_map<TileIndex, std::uint32_t> block_by_tile_;
  std::vector<Block> blocks_;
  std::vector<Cover> cover_;
};

}  // namespace lifeline::search
