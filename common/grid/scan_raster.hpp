#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/grid/free_outline.hpp"
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
  /// 64 x 64 cells. Surfaces are drawn in the columns [first[row], last[row]) only; free space,
  /// most of a scan, is bits, and counts where no surface is drawn.
  struct Tile {
    TileIndex index;
    TsdTile surfaces{};
    std::array<std::uint8_t, kTileSide> first{};
    std::array<std::uint8_t, kTileSide> last{};
    std::array<std::uint64_t, kTileSide> free{};  ///< of each row: bit x is column x
  };

  ScanRaster(GridGeometry geometry, RasterConfig config);

  /// Draws a scan's surfaces as seen from `T_map_head`, with all weights times `weight`. What was
  /// drawn before is gone.
  void draw(std::span<const SurfacePiece> pieces, const Pose2& T_map_head, float weight);

  /// The tiles with anything drawn. Cells of weight 0 are not drawn.
  [[nodiscard]] std::span<const std::unique_ptr<Tile>> tiles() const {
    return std::span(tiles_).first(used_);
  }
  /// What a cell of free space is in this scan.
  [[nodiscard]] TsdCell free_cell() const { return free_cell_; }
  /// What this scan shows in one cell of a tile, by its offset_in_tile().
  [[nodiscard]] TsdCell cell(const Tile& tile, std::size_t offset) const {
    const TsdCell surface = tile.surfaces[offset];
    const bool is_free = (tile.free[offset / kTileSide] >> (offset % kTileSide) & 1U) != 0;
    return surface.known() || !is_free ? surface : free_cell_;
  }

 private:
  /// A piece of surface in cells, in the raster's frame.
  struct DrawnPiece {
    Eigen::Vector2f point, normal;
    float left, right;
    float quality;
  };
  void clear();
  void draw_piece(const DrawnPiece& piece);
  void draw_row(const DrawnPiece& piece, std::int32_t row, std::int32_t first, std::int32_t last);
  void fill_outline();
  /// Calls use(tile, corner, x, end) for each tile's share of the cells first ... last of a row:
  /// [x, end) of them, where the tile's first one is cell `corner`.
  template <typename Use>
  void each_stretch(std::int32_t row, std::int32_t first, std::int32_t last, Use&& use);
  /// The tile at this place of the directory; nullptr outside of it and of the map's range.
  [[nodiscard]] Tile* tile_at(TileIndex local);
  [[nodiscard]] Tile* add_tile(TileIndex local, std::int32_t& slot);

  GridGeometry geometry_;
  float free_weight_;
  TsdCell free_cell_;
  float behind_;                              ///< in cells: how deep surfaces are drawn ...
  float before_;                              ///< ... and how far before them
  float one_per_cell_;                        ///< signed distance, in TsdCell units
  std::vector<std::unique_ptr<Tile>> tiles_;  ///< the first `used_` hold this scan
  std::size_t used_ = 0;
  TileIndex first_tile_{};  ///< of the directory
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<std::int32_t> directory_;  ///< position in tiles_, -1 = none
  FreeOutline outline_;
};

}  // namespace lifeline
