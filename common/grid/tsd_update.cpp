#include "common/grid/tsd_update.hpp"

#include <cmath>

#include "common/base/check.hpp"

namespace lifeline {

TsdUpdater::TsdUpdater(GridGeometry geometry, PushConfig config)
    : geometry_(geometry),
      weight_cap_(static_cast<int>(std::lround(config.weight_cap * TsdCell::kWeightOne))),
      raster_(geometry, config.raster) {
  // 256 keeps the sum of Eq. 2 within 32 bits.
  LIFELINE_CHECK(config.weight_cap >= 1.0 && config.weight_cap <= 256.0);
}

std::span<const TileIndex> TsdUpdater::push(std::span<const SurfacePiece> pieces,
                                            const Pose2& T_map_head, double weight, TsdGrid& grid,
                                            Looks looks) {
  LIFELINE_CHECK(grid.geometry() == geometry_);
  LIFELINE_CHECK(T_map_head.is_finite() && weight > 0.0 && weight <= 1.0);
  changed_.clear();
  raster_.draw(pieces, T_map_head, static_cast<float>(weight));
  for (const auto& seen : raster_.tiles()) {
    if (merge(*seen, grid.at(seen->index), looks)) changed_.push_back(seen->index);
  }
  std::sort(changed_.begin(), changed_.end());
  return changed_;
}

bool TsdUpdater::merge(const ScanRaster::Tile& seen, TsdTile& tile, Looks looks) const {
  bool changed = false;
  for (std::size_t row = 0; row < kTileSide; ++row) {
    const std::size_t end = row * kTileSide + seen.last[row];
    for (std::size_t i = row * kTileSide + seen.first[row]; i < end; ++i) {
      const TsdCell before = tile[i];
      const TsdCell after = looks == Looks::dense
                                ? updated_densely(before, seen.cells[i], weight_cap_)
                                : updated(before, seen.cells[i], weight_cap_);
      if (after == before) continue;
      tile[i] = after;
      changed = true;
    }
  }
  return changed;
}

}  // namespace lifeline
