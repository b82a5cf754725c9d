#include "common/sharing/fused_map.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::sharing {

FusedMap::FusedMap(GridGeometry geometry)
    : geometry_(geometry), cell_size_um_(std::llround(geometry.cell_size_m * 1e6)) {}

void FusedMap::place(std::vector<Placement> placements, const ReplicaStore& store) {
  std::sort(placements.begin(), placements.end(),
            [](const Placement& a, const Placement& b) { return a.layer < b.layer; });
  if (placements == placements_) return;
  placements_ = std::move(placements);
  for (const auto& [tile, cells] : tiles_) marked_.insert(tile);
  for (const Placement& placement : placements_) {
    const auto* layer = store.find(placement.layer);
    if (layer == nullptr) continue;
    for (const auto& [tile, held] : *layer) mark({placement.layer, tile});
  }
}

void FusedMap::mark(const ReplicaStore::ChangedTile& changed) {
  for (const Placement& placement : placements_) {
    if (placement.layer != changed.layer) continue;
    const auto touched = tiles_touched(changed.tile, placement.T_fused_layer, cell_size_um_);
    marked_.insert(touched.begin(), touched.end());
  }
}

std::vector<TileIndex> FusedMap::update(const ReplicaStore& store) {
  std::vector<FusedMember> members;
  for (const Placement& placement : placements_) {
    if (const auto* layer = store.find(placement.layer); layer != nullptr) {
      members.push_back({layer, placement.T_fused_layer});
    }
  }
  std::vector<TileIndex> changed;
  FusedTile fused;
  for (const TileIndex tile : marked_) {
    const bool known = fuse_tile(tile, members, cell_size_um_, fused);
    const auto held = tiles_.find(tile);
    if (!known) {
      if (held == tiles_.end()) continue;
      tiles_.erase(held);
    } else {
      if (held != tiles_.end() && held->second == fused) continue;
      tiles_[tile] = fused;
    }
    changed.push_back(tile);
  }
  marked_.clear();
  return changed;
}

Sha256Digest FusedMap::sha256() const {
  static_assert(sizeof(FusedCell) == 2 && sizeof(FusedTile) == 2 * kTileCells, "hashed as octets");
  Sha256 hash;
  for (const auto& [tile, cells] : tiles_) {
    hash.add_integer(static_cast<std::uint32_t>(tile.x));
    hash.add_integer(static_cast<std::uint32_t>(tile.y));
    hash.add({reinterpret_cast<const std::uint8_t*>(cells.data()), sizeof(cells)});
  }
  return hash.finish();
}

TsdGrid FusedMap::to_grid() const {
  TsdGrid grid(geometry_);
  for (const auto& [tile, cells] : tiles_) grid.at(tile) = to_tsd_tile(cells);
  return grid;
}

TsdTile to_tsd_tile(const FusedTile& tile) {
  TsdTile cells;
  std::transform(tile.begin(), tile.end(), cells.begin(), [](FusedCell cell) {
    return dequantise(
        QuantisedCell{cell.tsd, std::min<std::uint8_t>(cell.weight, QuantisedCell::kMaxWeight)});
  });
  return cells;
}

}  // namespace lifeline::sharing
