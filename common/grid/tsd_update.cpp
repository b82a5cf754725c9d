#include "common/grid/tsd_update.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/check.hpp"
#include "common/grid/cell_lanes.hpp"

namespace lifeline {
namespace {

enum class Merge {
  nothing,  ///< was to be changed
  done,     ///< as updated() would, and updated_densely()
  unequal,  ///< some distance moves: not done
};

/// Merges kLanes cells that are not seen, seen for the first time, or seen just as they are: most
/// of all, free space. Only weights grow.
Merge merge_equals(const TsdCell* seen, TsdCell* cells, int weight_cap) {
  const IntLanes was = load_cells(cells), is = load_cells(seen), cap = IntLanes{} + weight_cap;
  const IntLanes is_known = was > kTsdBits, is_seen = is > kTsdBits;
  if (any(is_known & is_seen & ((was ^ is) << 16))) return Merge::unequal;
  const IntLanes sum = (was >> 16) + (is >> 16);
  const IntLanes weight = choose(sum > cap, cap, sum);
  const IntLanes tsd = (was | is) & kTsdBits;  // that of an unknown cell is 0
  const IntLanes after = choose(is_seen, (weight << 16) | tsd, was);
  if (!any(after ^ was)) return Merge::nothing;
  store_cells(after, cells);
  return Merge::done;
}

}  // namespace

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
    // Beside the drawn columns nothing is seen, and nothing is changed.
    const std::size_t first = row * kTileSide + std::size_t{seen.first[row]} / kLanes * kLanes;
    const std::size_t end = row * kTileSide + seen.last[row];
    for (std::size_t i = first; i < end; i += kLanes) {
      Merge merged = merge_equals(&seen.cells[i], &tile[i], weight_cap_);
      if (merged == Merge::unequal && merge_each(&seen.cells[i], &tile[i], looks)) {
        merged = Merge::done;
      }
      changed = changed || merged == Merge::done;
    }
  }
  return changed;
}

bool TsdUpdater::merge_each(const TsdCell* seen, TsdCell* cells, Looks looks) const {
  bool changed = false;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const TsdCell before = cells[i];
    const TsdCell after = looks == Looks::dense ? updated_densely(before, seen[i], weight_cap_)
                                                : updated(before, seen[i], weight_cap_);
    if (after == before) continue;
    cells[i] = after;
    changed = true;
  }
  return changed;
}

}  // namespace lifeline
