#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline {

/// How a scan becomes signed distances.
struct RasterConfig {
  float behind_m = 0.15F;    ///< surfaces are drawn this deep, losing weight with the square
  float free_weight = 0.5F;  ///< of a cell that a beam passed far from any surface
};

/// The signed distances of one scan alone, tsdf_k and w_k of Eq. 2: each cell once, whatever the
/// number of beams. Near a surface the distance is perpendicular to it, the nearest surface counts,
/// and there are no holes between beams; before the surfaces all is free (+1); behind them, and
/// where beams returned nothing, nothing is drawn. Keeps its memory from scan to scan.
class ScanRaster {
 public:
  /// 64 x 64 cells, drawn in the columns [first[row], last[row]) only.
  struct Tile {
    TileIndex index;
    TsdTile cells{};
    std::array<std::uint8_t, kTileSide> first{};
    std::array<std::uint8_t, kTileSide> last{};
  };

  ScanRaster(GridGeometry geometry, RasterConfig config);

  /// Draws a scan's surfaces as seen from `T_map_head`, with all weights times `weight`. What was
  /// drawn before is gone.
  void draw(std::span<const SurfacePiece> pieces, const Pose2& T_map_head, float weight);

  /// The tiles with anything drawn. Cells of weight 0 are not drawn.
  [[nodiscard]] std::span<const std::unique_ptr<Tile>> tiles() const {
    return std::span(tiles_).first(used_);
  }

 private:
  struct Crossing {
    float x = 0.0F;
    std::int32_t direction = 0;
  };
  void clear();
  void draw_piece(const SurfacePiece& piece, const Pose2& T_raster_head, float weight);
  void draw_row(const SurfacePiece& piece, std::int32_t row, std::int32_t first, std::int32_t last);
  void trace_outline(std::span<const SurfacePiece> pieces, const Pose2& T_raster_head);
  void fill_outline(float weight);
  void fill_row(std::int32_t row, std::int32_t first, std::int32_t last, TsdCell value);
  [[nodiscard]] Tile* tile_at(TileIndex index);

  GridGeometry geometry_;
  RasterConfig config_;
  std::vector<std::unique_ptr<Tile>> tiles_;  ///< the first `used_` hold this scan
  std::size_t used_ = 0;
  TileIndex first_tile_{};  ///< of the directory
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<std::int32_t> directory_;   ///< position in tiles_, -1 = none
  std::vector<float> reach_m_;            ///< of the free space before each piece
  std::vector<Eigen::Vector2f> outline_;  ///< of the free space seen, closed, in cells
  std::vector<std::int32_t> row_start_;   ///< where each row's crossings begin
  std::vector<Crossing> crossings_;
};

}  // namespace lifeline
