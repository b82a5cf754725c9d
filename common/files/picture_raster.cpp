#include "common/files/picture_raster.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::files {
namespace {

/// Columns and rows of a grid, the last one not included.
struct CellBox {
  int left = 0, right = 0, bottom = 0, top = 0;

  [[nodiscard]] int width() const { return right - left; }
  [[nodiscard]] int height() const { return top - bottom; }
};

CellBox known_box(const OccupancyGrid& grid) {
  CellBox box{grid.columns, 0, grid.rows, 0};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.at(column, row) == Occupancy::unknown) continue;
      box = {std::min(box.left, column), std::max(box.right, column + 1), std::min(box.bottom, row),
             std::max(box.top, row + 1)};
    }
  }
  return box.width() > 0 ? box : CellBox{};
}

/// The cell of a square of cells that shows: a wall before free floor before the unknown.
Occupancy most_telling(const OccupancyGrid& grid, int column, int row, int side) {
  static_assert(Occupancy::occupied > Occupancy::free && Occupancy::free > Occupancy::unknown);
  Occupancy telling = Occupancy::unknown;
  for (int y = row; y < row + side; ++y) {
    for (int x = column; x < column + side; ++x) telling = std::max(telling, grid.at(x, y));
  }
  return telling;
}

}  // namespace

PictureRaster to_picture_raster(const OccupancyGrid& grid, int aim_px, int most_px) {
  constexpr double kMargin_m = 0.5;
  constexpr int kMostPixelsPerCell = 8;
  const int margin = std::max(4, static_cast<int>(std::lround(kMargin_m / grid.cell_size_m)));
  CellBox box = known_box(grid);
  box = {box.left - margin, box.right + margin, box.bottom - margin, box.top + margin};
  const int longest = std::max(box.width(), box.height());
  const int cells_per_pixel = (longest + most_px - 1) / most_px;
  const int pixels_per_cell =
      cells_per_pixel > 1 ? 1 : std::clamp((aim_px + longest / 2) / longest, 1, kMostPixelsPerCell);

  const int columns = (box.width() + cells_per_pixel - 1) / cells_per_pixel;
  const int rows = (box.height() + cells_per_pixel - 1) / cells_per_pixel;
  PictureRaster raster;
  raster.width_px = columns * pixels_per_cell;
  raster.height_px = rows * pixels_per_cell;
  raster.pixels_per_m = pixels_per_cell / (cells_per_pixel * grid.cell_size_m);
  const int top = box.bottom + rows * cells_per_pixel;
  raster.upper_left_m = grid.origin_m + Eigen::Vector2d(box.left, top) * grid.cell_size_m;
  raster.pixels.reserve(static_cast<std::size_t>(raster.width_px) *
                        static_cast<std::size_t>(raster.height_px));
  for (int y = 0; y < raster.height_px; ++y) {
    const int row = top - (y / pixels_per_cell + 1) * cells_per_pixel;
    for (int x = 0; x < raster.width_px; ++x) {
      const int column = box.left + x / pixels_per_cell * cells_per_pixel;
      raster.pixels.push_back(most_telling(grid, column, row, cells_per_pixel));
    }
  }
  return raster;
}

}  // namespace lifeline::files
