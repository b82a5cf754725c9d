#include "agents/hud/hud_map.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::hud {
namespace {

/// Calls use(x, y) for each place of a square of `side` that lies at most `ring` from its edge;
/// for all where `whole`.
template <typename Use>
void each_place(int side, int ring, bool whole, Use&& use) {
  for (int y = 0; y < side; ++y) {
    const bool full = whole || y < ring || y >= side - ring;
    for (int x = 0; x < side; ++x) {
      if (!full && x == ring) x = side - ring;
      use(x, y);
    }
  }
}

constexpr int kClearCells = 2;  // around a block, so that a shoulder meets no wall

}  // namespace

CellIndex cell_at(const Eigen::Vector2d& p_map_m, double cell_size_m) {
  const Eigen::Vector2d cell = p_map_m / cell_size_m;
  return {static_cast<std::int32_t>(std::floor(cell.x())),
          static_cast<std::int32_t>(std::floor(cell.y()))};
}

HudMap::HudMap(double cell_size_m) : cell_size_m_(cell_size_m) {}

HudMap::Tile* HudMap::make(TileIndex tile) {
  if (const auto found = tiles_.find(tile); found != tiles_.end()) return &found->second;
  if (tiles_.size() >= kMostTiles || !is_in_range(tile)) return nullptr;
  return &tiles_[tile];
}

const HudMap::Tile* HudMap::find(TileIndex tile) const {
  const auto found = tiles_.find(tile);
  return found == tiles_.end() ? nullptr : &found->second;
}

void HudMap::put(const sharing::MapTiles& own) {
  for (const auto& [index, cells] : own) {
    Tile* tile = make(index);
    if (tile == nullptr) continue;
    tile->own = cells;
    changed_.insert(index);
  }
}

void HudMap::put(const sharing::PeerUpdate& peers) {
  for (const auto& [index, cells] : peers.tiles) {
    Tile* tile = make(index);
    if (tile == nullptr) continue;
    tile->peers = cells;
    changed_.insert(index);
  }
}

HudMap::Distance HudMap::distance(const Tile& tile, std::size_t offset) {
  if (tile.own != nullptr && (*tile.own)[offset].weight != 0)
    return {true, (*tile.own)[offset].tsd};
  if (tile.peers != nullptr && (*tile.peers)[offset].known())
    return {true, (*tile.peers)[offset].tsd};
  return {};
}

HudMap::Distance HudMap::distance(CellIndex cell) const {
  const Tile* tile = find(tile_of(cell));
  return tile == nullptr ? Distance{} : distance(*tile, offset_in_tile(cell));
}

Occupancy HudMap::classify(CellIndex cell, const Tile& tile) const {
  const Distance here = distance(tile, offset_in_tile(cell));
  if (!here.known) return Occupancy::unknown;
  if (here.tsd == 0) return Occupancy::occupied;
  const TileIndex own = tile_of(cell);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const CellIndex beside{cell.x + dx, cell.y + dy};
    const Distance there =
        tile_of(beside) == own ? distance(tile, offset_in_tile(beside)) : distance(beside);
    if (there.known && (there.tsd < 0) != (here.tsd < 0) && there.tsd != 0)
      return Occupancy::occupied;
  }
  return here.tsd > 0 ? Occupancy::free : Occupancy::unknown;
}

bool HudMap::refresh() {
  if (changed_.empty()) return false;
  // What lies beside a changed tile looks different at its edge alone.
  std::map<TileIndex, bool> wholes;
  for (const TileIndex tile : changed_) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const TileIndex beside{tile.x + dx, tile.y + dy};
        if (tiles_.contains(beside)) wholes[beside] |= dx == 0 && dy == 0;
      }
    }
  }
  changed_.clear();
  for (const auto& [index, whole] : wholes) classify(index, whole);
  for (const auto& [index, whole] : wholes) {
    shade(index, whole);
    find_passable(index, whole);
  }
  return true;
}

void HudMap::classify(TileIndex index, bool whole) {
  const CellIndex first = first_cell(index);
  Tile& tile = tiles_.at(index);
  each_place(kTileSide, 1, whole, [&](int x, int y) {
    const CellIndex cell{first.x + x, first.y + y};
    tile.cells[offset_in_tile(cell)] = classify(cell, tile);
  });
}

/// A free cell beside a wall is drawn as wall.
void HudMap::shade(TileIndex index, bool whole) {
  const CellIndex first = first_cell(index);
  Tile& tile = tiles_.at(index);
  const auto is_wall = [&](int x, int y) {
    const CellIndex cell{first.x + x, first.y + y};
    const bool inside = x >= 0 && y >= 0 && x < kTileSide && y < kTileSide;
    return (inside ? tile.cells[offset_in_tile(cell)] : at(cell)) == Occupancy::occupied;
  };
  each_place(kTileSide, 2, whole, [&](int x, int y) {
    const std::size_t offset = offset_in_tile({x, y});
    Occupancy shade = tile.cells[offset];
    if (shade == Occupancy::free &&
        (is_wall(x + 1, y) || is_wall(x - 1, y) || is_wall(x, y + 1) || is_wall(x, y - 1))) {
      shade = Occupancy::occupied;
    }
    tile.shades[offset] = shade;
  });
}

void HudMap::find_passable(TileIndex index, bool whole) {
  const CellIndex first = first_cell(index);
  Tile& tile = tiles_.at(index);
  const auto cell_of = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < kTileSide && y < kTileSide;
    return inside ? tile.cells[offset_in_tile({x, y})] : at({first.x + x, first.y + y});
  };
  const auto fits = [&](int low_x, int low_y) {
    for (int y = low_y - kClearCells; y < low_y + kBlockCells + kClearCells; ++y) {
      for (int x = low_x - kClearCells; x < low_x + kBlockCells + kClearCells; ++x) {
        const bool own =
            x >= low_x && y >= low_y && x < low_x + kBlockCells && y < low_y + kBlockCells;
        const Occupancy cell = cell_of(x, y);
        if (own ? cell != Occupancy::free : cell == Occupancy::occupied) return false;
      }
    }
    return true;
  };
  each_place(kBlocksPerTile, 1, whole, [&](int x, int y) {
    tile.passable[static_cast<std::size_t>(y * kBlocksPerTile + x)] =
        fits(x * kBlockCells, y * kBlockCells);
  });
}

const HudMap::Shades* HudMap::shades(TileIndex tile) const {
  const Tile* found = find(tile);
  return found == nullptr ? nullptr : &found->shades;
}

Occupancy HudMap::at(CellIndex cell) const {
  const Tile* tile = find(tile_of(cell));
  return tile == nullptr ? Occupancy::unknown : tile->cells[offset_in_tile(cell)];
}

bool HudMap::is_passable(CellIndex block) const {
  // Arithmetic shift: floor division, for negative indices too.
  static_assert(kBlocksPerTile == 16 && kBlockCells == 4, "shifts by 4");
  const Tile* tile = find({block.x >> 4, block.y >> 4});
  return tile != nullptr &&
         tile->passable[static_cast<std::size_t>((block.y & 15) * kBlocksPerTile + (block.x & 15))];
}

}  // namespace lifeline::hud
