#include "common/grid/tsd_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "common/base/check.hpp"
#include "common/base/cpu_clones.hpp"
#include "common/grid/cell_lanes.hpp"

namespace lifeline {
namespace {

enum class Merge {
  nothing,  ///< was to be changed
  done,     ///< as updated() would, and updated_densely()
  unequal,  ///< some distance moves: not done
};

/// Merges kCount cells that are not seen, seen for the first time, or seen just as they are: most
/// of all, free space. Only weights grow.
template <std::size_t kCount>
inline Merge merge_equals(const TsdCell* seen, TsdCell* cells, std::int32_t weight_cap) {
  std::array<std::int32_t, kCount> was, is, after;
  std::memcpy(was.data(), cells, sizeof was);
  std::memcpy(is.data(), seen, sizeof is);
  std::int32_t moved = 0, changed = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool both = was[i] > kTsdBits && is[i] > kTsdBits;
    moved |= both ? (was[i] ^ is[i]) & kTsdBits : 0;
    const std::int32_t weight = std::min((was[i] >> 16) + (is[i] >> 16), weight_cap);
    const std::int32_t tsd = (was[i] | is[i]) & kTsdBits;  // that of an unknown cell is 0
    after[i] = is[i] > kTsdBits ? (weight << 16) | tsd : was[i];
    changed |= after[i] ^ was[i];
  }
  if (moved != 0) return Merge::unequal;
  if (changed == 0) return Merge::nothing;
  std::memcpy(static_cast<void*>(cells), after.data(), sizeof after);
  return Merge::done;
}

inline bool merge_each(const TsdCell* seen, TsdCell* cells, std::size_t count, Looks looks,
                       int weight_cap) {
  bool changed = false;
  for (std::size_t i = 0; i < count; ++i) {
    const TsdCell before = cells[i];
    const TsdCell after = looks == Looks::dense ? updated_densely(before, seen[i], weight_cap)
                                                : updated(before, seen[i], weight_cap);
    if (after == before) continue;
    cells[i] = after;
    changed = true;
  }
  return changed;
}

/// Whether any cell changed.
LIFELINE_ALSO_FOR_AVX2
bool merge_tile(const ScanRaster::Tile& seen, TsdTile& tile, Looks looks, int weight_cap) {
  constexpr std::size_t kMany = 16, kFew = 4;
  static_assert(kTileSide % kMany == 0);
  bool changed = false;
  for (std::size_t row = 0; row < kTileSide; ++row) {
    // Beside the drawn columns nothing is seen, and nothing is changed.
    const std::size_t first = row * kTileSide + std::size_t{seen.first[row]} / kMany * kMany;
    const std::size_t end = row * kTileSide + seen.last[row];
    for (std::size_t i = first; i < end; i += kMany) {
      const Merge merged = merge_equals<kMany>(&seen.cells[i], &tile[i], weight_cap);
      changed |= merged == Merge::done;
      if (merged != Merge::unequal) continue;
      for (std::size_t k = i; k < i + kMany; k += kFew) {
        const Merge few = merge_equals<kFew>(&seen.cells[k], &tile[k], weight_cap);
        changed |= few == Merge::done;
        if (few != Merge::unequal) continue;
        changed |= merge_each(&seen.cells[k], &tile[k], kFew, looks, weight_cap);
      }
    }
  }
  return changed;
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
    if (merge_tile(*seen, grid.at(seen->index), looks, weight_cap_))
      changed_.push_back(seen->index);
  }
  std::sort(changed_.begin(), changed_.end());
  return changed_;
}

}  // namespace lifeline
