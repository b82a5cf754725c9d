#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline {

/// The free space that a scan shows, as one closed outline: from the head to a truncation distance
/// before the surfaces. Keeps its memory from scan to scan.
class FreeOutline {
 public:
  /// A run of cells in a row.
  struct Run {
    std::int32_t row, first, last;
  };

  /// Traces the outline; `T_raster_head` in cells.
  void trace(std::span<const SurfacePiece> pieces, const Pose2& T_raster_head,
             const GridGeometry& geometry);
  /// The cells of the rows [0, rows) whose centres lie within; valid until the next call. Empty
  /// runs may be among them.
  [[nodiscard]] std::span<const Run> runs(std::int32_t rows);

 private:
  struct Crossing {
    float x = 0.0F;
    std::int32_t direction = 0;
  };
  void set_reaches(std::span<const SurfacePiece> pieces, float truncation_m);
  void find_crossings(std::int32_t rows);
  void add_runs(std::int32_t row, std::span<Crossing> crossings);

  std::vector<float> reach_m_;            ///< of the free space before each piece
  std::vector<Eigen::Vector2f> outline_;  ///< closed, in cells
  std::vector<Crossing> found_;           ///< edge by edge ...
  std::vector<std::int32_t> found_row_;   ///< ... in this row
  std::vector<std::int32_t> row_start_;   ///< where each row's crossings begin
  std::vector<Crossing> crossings_;       ///< row by row
  std::vector<Run> runs_;
};

/// The cell with the first centre at or after x, in cells.
[[nodiscard]] inline std::int32_t first_centre_from(float x) {
  // std::ceil without a call. Whatever is this far away lies in no raster.
  const float at = x - 0.5F;
  const auto whole = static_cast<std::int32_t>(at);
  return whole + (static_cast<float>(whole) < at ? 1 : 0);
}
/// The cell with the last centre up to x.
[[nodiscard]] inline std::int32_t last_centre_to(float x) {
  const float at = x - 0.5F;
  const auto whole = static_cast<std::int32_t>(at);
  return whole - (static_cast<float>(whole) > at ? 1 : 0);
}

}  // namespace lifeline
