#include "common/grid/tsd_update.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "common/base/check.hpp"
#include "common/base/cpu_clones.hpp"
#include "common/grid/cell_lanes.hpp"

namespace lifeline {
namespace {

constexpr std::int32_t kMany = 16;
static_assert(kTileSide % kMany == 0 && kMany % kLanes == 0);
/// Cells next to each other in a row, each as an integer (cell_lanes.hpp).
using ManyCells = std::array<std::int32_t, kMany>;

enum class Merge {
  nothing,  ///< was to be changed
  done,     ///< as updated() would, and updated_densely()
  unequal,  ///< some distance moves: not done
};

/// Merges cells that are not seen, seen for the first time, or seen just as they are: most of all,
/// free space. Only weights grow.
inline Merge merge_equals(const ManyCells& is, TsdCell* cells, std::int32_t weight_cap) {
  ManyCells was, after;
  std::memcpy(was.data(), cells, sizeof was);
  std::int32_t moved = 0, changed = 0;
  for (std::size_t i = 0; i < was.size(); ++i) {
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

/// The quotients, cut off. Of whole numbers up to 2^31, by up to 2^16, in double precision: exact.
inline IntLanes quotients(IntLanes dividend, IntLanes divisor) {
  using DoubleLanes = double __attribute__((vector_size(4 * sizeof(double))));
  return __builtin_convertvector(__builtin_convertvector(dividend, DoubleLanes) /
                                     __builtin_convertvector(divisor, DoubleLanes),
                                 IntLanes);
}

/// Cells apart: weight and signed distance.
struct CellParts {
  explicit CellParts(IntLanes cells)
      : known(cells > kTsdBits), weight(cells >> 16), tsd((cells << 16) >> 16) {}
  IntLanes known, weight, tsd;
};

inline IntLanes joined(IntLanes weight, IntLanes tsd) {
  return (weight << 16) | (tsd & kTsdBits);
}

inline IntLanes are_hidden_sides(const CellParts& was, const CellParts& is) {
  return (is.tsd < kDeepBehind) & (was.tsd > 0) & (was.weight > 4 * is.weight);
}

/// updated(), four cells at a time. Equal distances need no case of their own: they neither
/// contradict nor hide each other, and their mean is what they are.
inline IntLanes updated_four(IntLanes cells, IntLanes seen, std::int32_t weight_cap) {
  const CellParts was(cells), is(seen);
  const IntLanes worn = was.weight * is.weight / (4 * TsdCell::kWeightOne);
  const IntLanes contradicts = magnitude(is.tsd - was.tsd) > kContradiction;
  const IntLanes weight = choose(contradicts, was.weight - worn, was.weight);
  const IntLanes total = weight + is.weight, sum = was.tsd * weight + is.tsd * is.weight;
  const IntLanes half = total / 2, both = was.known & is.known;
  const IntLanes mean =
      quotients(sum + choose(sum < 0, -half, half), choose(both, total, both + 1));
  const IntLanes capped = choose(total > weight_cap, IntLanes{} + weight_cap, total);
  const IntLanes merged = choose(are_hidden_sides(was, is), cells, joined(capped, mean));
  return choose(is.known, choose(was.known, merged, seen), cells);
}

/// updated_densely(), four cells at a time.
inline IntLanes updated_four_densely(IntLanes cells, IntLanes seen, std::int32_t weight_cap) {
  const CellParts was(cells), is(seen);
  const IntLanes contradicts = was.known & is.known &
                               (magnitude(is.tsd - was.tsd) > kDenseContradiction) &
                               ~are_hidden_sides(was, is);
  const IntLanes lost = was.weight * is.weight * 5 / (8 * TsdCell::kWeightOne);
  const IntLanes left = was.weight - choose(lost > 1, lost, IntLanes{} + 1);
  const IntLanes worn = choose(left <= 2 * is.weight, seen, joined(left, was.tsd));
  return choose(contradicts, worn, updated_four(cells, seen, weight_cap));
}

/// Whether any cell changed.
inline bool merge_unequal(const ManyCells& seen, TsdCell* cells, Looks looks, int weight_cap) {
  IntLanes changed{};
  for (std::size_t i = 0; i < seen.size(); i += kLanes) {
    IntLanes is;
    std::memcpy(&is, &seen[i], sizeof is);
    const IntLanes was = load_cells(cells + i);
    const IntLanes after = looks == Looks::dense ? updated_four_densely(was, is, weight_cap)
                                                 : updated_four(was, is, weight_cap);
    store_cells(after, cells + i);
    changed |= was ^ after;
  }
  return any(changed);
}

/// Free space among the cells where no surface is drawn; bit i is cell i.
inline ManyCells with_free(const ManyCells& surfaces, std::uint64_t free, std::int32_t free_cell) {
  ManyCells seen;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::int32_t cell = (static_cast<std::uint32_t>(free) >> i & 1U) != 0 ? free_cell : 0;
    seen[i] = surfaces[i] > kTsdBits ? surfaces[i] : cell;
  }
  return seen;
}

/// Whether any cell changed.
LIFELINE_ALSO_FOR_AVX2
bool merge_tile(const ScanRaster::Tile& seen, TsdTile& tile, TsdCell free, Looks looks,
                int weight_cap) {
  constexpr std::uint64_t kAll = (std::uint64_t{1} << kMany) - 1;
  const auto free_cell = std::bit_cast<std::int32_t>(free);
  ManyCells all_free;
  all_free.fill(free_cell);
  bool changed = false;
  for (std::size_t row = 0; row < kTileSide; ++row) {
    for (std::int32_t x = 0; x < kTileSide; x += kMany) {
      const std::uint64_t is_free = seen.free[row] >> x & kAll;
      const bool has_surface = seen.first[row] < x + kMany && x < seen.last[row];
      if (is_free == 0 && !has_surface) continue;
      const std::size_t at = row * kTileSide + static_cast<std::size_t>(x);
      ManyCells is = all_free;
      if (has_surface || is_free != kAll) {
        ManyCells surfaces{};
        if (has_surface) std::memcpy(surfaces.data(), &seen.surfaces[at], sizeof surfaces);
        is = with_free(surfaces, is_free, free_cell);
      }
      const Merge merged = merge_equals(is, &tile[at], weight_cap);
      changed |= merged == Merge::done ||
                 (merged == Merge::unequal && merge_unequal(is, &tile[at], looks, weight_cap));
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
    if (merge_tile(*seen, grid.at(seen->index), raster_.free_cell(), looks, weight_cap_))
      changed_.push_back(seen->index);
  }
  std::sort(changed_.begin(), changed_.end());
  return changed_;
}

}  // namespace lifeline
