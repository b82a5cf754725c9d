#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"

namespace lifeline::files {

/// The part of a grid that a picture shows, in pixels, the uppermost row first.
struct PictureRaster {
  int width_px = 0;
  int height_px = 0;
  std::vector<Occupancy> pixels;
  double pixels_per_m = 0.0;
  Eigen::Vector2d upper_left_m{0.0, 0.0};  ///< of the picture, in the map's frame

  [[nodiscard]] Eigen::Vector2d to_pixel(const Eigen::Vector2d& p_map) const {
    return {(p_map.x() - upper_left_m.x()) * pixels_per_m,
            (upper_left_m.y() - p_map.y()) * pixels_per_m};
  }
};

/// What is known of the grid with a margin of unknown about it, each cell a square of pixels. Where
/// even one pixel a cell is beyond `most_px` a side, several cells share a pixel: a wall among them
/// shows, else free floor. A grid with nothing known gives an unknown picture.
[[nodiscard]] PictureRaster to_picture_raster(const OccupancyGrid& grid, int aim_px, int most_px);

}  // namespace lifeline::files
