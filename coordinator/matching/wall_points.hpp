#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::matching {

/// A piece of wall as seen from its free side.
struct WallPoint {
  Eigen::Vector2f p;       ///< on the wall's face, metres, in the features' local frame
  Eigen::Vector2f normal;  ///< unit length, towards the free side
  float length_m = 0.0F;   ///< length of wall that this point stands for
};

/// Occupied cells nearer than this to the border of a grid are not looked at, so that all have
/// neighbours: crop_to_known() gives maps such a border.
inline constexpr int kWallMargin = 8;

/// The faces of the occupied cells of `grid`. A wall that was seen from both sides gives points on
/// both faces. Positions and normals come from a line fitted to the neighbouring face cells, so
/// they are finer than a cell. Local frame: the grid's origin is the origin.
[[nodiscard]] std::vector<WallPoint> wall_points(const OccupancyGrid& grid);

/// The zero crossings of a TSD layer, with the gradient as normal. `p_map_origin` becomes the
/// origin of the local frame.
[[nodiscard]] std::vector<WallPoint> wall_points(const TsdGrid& tsd,
                                                 const Eigen::Vector2d& p_map_origin);

/// One point per square of `spacing_m` and facing direction: the mean of those there, standing for
/// the length of wall that crosses such a square. Ordered by position.
[[nodiscard]] std::vector<WallPoint> thin_out(const std::vector<WallPoint>& points,
                                              float spacing_m);

}  // namespace lifeline::matching
