#pragma once

#include <cstddef>

#include "common/grid/occupancy_grid.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::matching {

/// How two maps' cells fare where both are known.
struct Overlap {
  std::size_t agreeing = 0;     ///< agr of Eq. 12: both free or both occupied
  std::size_t disagreeing = 0;  ///< dis of Eq. 13: one free, one occupied

  /// Eq. 12; `grid_cells` is gridx * gridy. 0 without cells.
  [[nodiscard]] double s_overlapping(double grid_cells) const;
  /// Eq. 13: ai = agr / (agr + dis); 0 where nothing overlaps.
  [[nodiscard]] double acceptance_index() const;
};

/// Lays the centres of b's cells on a by T_a_b, between the grids' corners (cell (0, 0) begins at
/// the origin of its frame). Unknown cells never count, not even on unknown ones.
[[nodiscard]] Overlap count_overlap(const OccupancyGrid& a, const OccupancyGrid& b,
                                    const Pose2& T_a_b);

}  // namespace lifeline::matching
