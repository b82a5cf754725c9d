#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "common/grid/pose2.hpp"
#include "common/grid/scan_raster.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline {

/// How scans enter the grid.
struct PushConfig {
  double weight_cap = 32.0;  ///< W never grows beyond: the grid keeps learning. At most 256.
  RasterConfig raster;
};

/// Two signed distances further apart than this (in TsdCell units) cannot both be true: the world
/// has changed, and the old one loses weight with each such observation.
inline constexpr int kContradiction = TsdCell::kTsdOne * 3 / 4;

/// The same among dense looks: half of the range of one side.
inline constexpr int kDenseContradiction = TsdCell::kTsdOne / 2;
/// Deep behind a surface.
inline constexpr int kDeepBehind = -TsdCell::kTsdOne * 2 / 5;

/// Does `seen` lie deep behind a surface, where `cell` was seen free from its own side?
[[nodiscard]] inline bool is_hidden_side(TsdCell cell, TsdCell seen) {
  return seen.tsd < kDeepBehind && cell.tsd > 0 && cell.weight > 4 * seen.weight;
}

/// Eq. 2 and 3 for one cell: the running mean of `cell` and `seen`, both weighted, the weight
/// capped at `weight_cap` (TsdCell units). An unknown `seen` changes nothing.
///
/// Beside the paper: a contradiction takes up to a quarter of the cell's weight away first, so that
/// a door that moved is learnt in a few scans; and what lies deep behind a surface does not
/// overrule a cell that was seen free from its own side - that is how thin walls survive.
[[nodiscard]] inline TsdCell updated(TsdCell cell, TsdCell seen, int weight_cap) {
  if (!seen.known()) return cell;
  if (!cell.known()) return seen;
  // The mean of equals, without a division: free space that is seen free again, most of all cells.
  if (seen.tsd == cell.tsd) {
    return {cell.tsd, static_cast<std::uint16_t>(std::min(cell.weight + seen.weight, weight_cap))};
  }
  if (is_hidden_side(cell, seen)) return cell;
  int weight = cell.weight;
  if (std::abs(seen.tsd - cell.tsd) > kContradiction) {
    weight -= weight * seen.weight / (4 * TsdCell::kWeightOne);
  }
  const int total = weight + seen.weight;
  const int sum = cell.tsd * weight + seen.tsd * seen.weight;
  const int half = sum >= 0 ? total / 2 : -total / 2;
  return {static_cast<std::int16_t>((sum + half) / total),
          static_cast<std::uint16_t>(std::min(total, weight_cap))};
}

/// How close a scan comes upon the one before it.
enum class Looks {
  sparse,  ///< keyframes: each look has to count at once
  dense,   ///< several a second from about one place: what one gets wrong, the next ones mend
};

/// updated() among dense looks (docs/decisions/0210). Two distances that differ by half of the
/// range of one side contradict each other. A contradiction leaves the cell's distance as it is and
/// takes up to five eighths of its weight; when no more is left than two such looks weigh, what is
/// seen takes the cell's place. So a door is learnt within 20 looks, however long it had stood
/// otherwise, and what is seen again in between, like glass, stays where it is.
[[nodiscard]] inline TsdCell updated_densely(TsdCell cell, TsdCell seen, int weight_cap) {
  const bool contradicts = cell.known() && seen.known() &&
                           std::abs(seen.tsd - cell.tsd) > kDenseContradiction &&
                           !is_hidden_side(cell, seen);
  if (!contradicts) return updated(cell, seen, weight_cap);
  const int lost = cell.weight * seen.weight * 5 / (8 * TsdCell::kWeightOne);
  const int left = cell.weight - std::max(1, lost);
  if (left <= 2 * seen.weight) return seen;
  return {cell.tsd, static_cast<std::uint16_t>(left)};
}

/// Pushes scans into TSD grids. Keeps scratch memory between scans; one owner.
class TsdUpdater {
 public:
  TsdUpdater(GridGeometry geometry, PushConfig config);

  /// Updates `grid` (of the geometry given at construction) with a scan taken at `T_map_head`,
  /// whose surfaces are `pieces`. `weight` in (0, 1] scales every w_k: how much this scan is
  /// trusted; `looks` how contradictions are taken. Cells beyond the largest tile index are left
  /// out. Returns the tiles in which any cell changed, ordered by x, then y; valid until the next
  /// push.
  std::span<const TileIndex> push(std::span<const SurfacePiece> pieces, const Pose2& T_map_head,
                                  double weight, TsdGrid& grid, Looks looks = Looks::sparse);

 private:
  GridGeometry geometry_;
  int weight_cap_;
  ScanRaster raster_;
  std::vector<TileIndex> changed_;
};

}  // namespace lifeline
