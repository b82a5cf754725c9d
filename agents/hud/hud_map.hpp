#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>

#include <Eigen/Core>

#include "agents/sharing/changed_tiles.hpp"
#include "agents/sharing/shared_map.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/grid/tile_index.hpp"

namespace lifeline::hud {

/// What a helmet knows of the building around it, in its own map frame: its own layer, and where
/// that knows nothing, what its team-mates saw. Cells are told apart by Eq. 6. One owner, not
/// thread-safe.
class HudMap {
 public:
  /// Blocks of 4 x 4 cells: what a person's way is planned on.
  static constexpr int kBlockCells = 4;
  static constexpr int kBlocksPerTile = kTileSide / kBlockCells;
  /// As many tiles as anybody's layer has; what comes beyond is left out.
  static constexpr std::size_t kMostTiles = 16384;

  explicit HudMap(double cell_size_m);

  /// What changed in the own layer, and in the peers' part of the map; refresh() makes it visible.
  void put(const sharing::MapTiles& own);
  void put(const sharing::PeerUpdate& peers);
  /// True: something looks different now.
  bool refresh();

  /// How a cell is drawn: its occupancy, walls one cell thicker, that they can be seen.
  using Shades = std::array<Occupancy, kTileCells>;
  /// nullptr where nothing is known.
  [[nodiscard]] const Shades* shades(TileIndex tile) const;

  [[nodiscard]] Occupancy at(CellIndex cell) const;
  /// Whether a person fits: all cells of the block were seen to be free, and no wall lies within
  /// two cells of it.
  [[nodiscard]] bool is_passable(CellIndex block) const;

  [[nodiscard]] double cell_size_m() const { return cell_size_m_; }
  [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }

 private:
  struct Tile {
    std::shared_ptr<const QuantisedTile> own;
    std::shared_ptr<const TsdTile> peers;
    Shades cells{};  ///< Occupancy::unknown is 0
    Shades shades{};
    std::array<bool, kBlocksPerTile * kBlocksPerTile> passable{};
  };
  [[nodiscard]] Tile* make(TileIndex tile);
  [[nodiscard]] const Tile* find(TileIndex tile) const;
  /// Signed distance as both halves know it: 0 on a surface; `known` false where neither does.
  struct Distance {
    bool known = false;
    std::int32_t tsd = 0;
  };
  [[nodiscard]] static Distance distance(const Tile& tile, std::size_t offset);
  [[nodiscard]] Distance distance(CellIndex cell) const;
  [[nodiscard]] Occupancy classify(CellIndex cell, const Tile& tile) const;
  // Of a tile, or of its edge alone.
  void classify(TileIndex index, bool whole);
  void shade(TileIndex index, bool whole);
  void find_passable(TileIndex index, bool whole);

  double cell_size_m_;
  std::unordered_map<TileIndex, Tile> tiles_;
  std::set<TileIndex> changed_;
};

/// The cell that holds a point of the map frame, metres.
[[nodiscard]] CellIndex cell_at(const Eigen::Vector2d& p_map_m, double cell_size_m);

}  // namespace lifeline::hud
