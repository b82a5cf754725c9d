#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/base/result.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/grid/tsd_grid.hpp"
#include "coordinator/matching/hough_spectrum.hpp"
#include "coordinator/matching/wall_field.hpp"
#include "coordinator/matching/wall_points.hpp"

namespace lifeline::matching {

/// Everything a match needs of one map, computed once per state of the map. Immutable once built:
/// any number of matches may read it at once.
///
/// Frame: a local one, parallel to the map's, with its origin at `origin_map_m`.
struct MapFeatures {
  double cell_size_m = 0.0;
  Eigen::Vector2d origin_map_m{0.0, 0.0};
  OccupancyGrid filtered;           ///< cropped to what is known, less noise: filter_noise()
  std::vector<WallPoint> walls;     ///< one per 0.1 m of wall, for refinement and verification
  std::vector<WallPoint> skeleton;  ///< one per 0.25 m, for the search
  WallField field;                  ///< of `walls`
  Spectrum oriented;                ///< oriented Hough spectrum of `walls`
  double wall_m = 0.0;              ///< length of all walls
  double known_m2 = 0.0;
  bool weighed = false;  ///< `field` is clear only where many beams passed: from a TSD layer
  /// The same map in a mirror: no building, but one of the same style. How well another map fits on
  /// it tells what chance gives. Has no mirror itself.
  std::shared_ptr<const MapFeatures> mirror;
};

/// One point of `walls` and of `skeleton` stands for about so much wall.
inline constexpr float kWallSpacing_m = 0.1F;
inline constexpr float kSkeletonSpacing_m = 0.25F;

/// Refuses (unsupported, bad_data) maps too large for a grid (check_grid_size), with more than 40
/// km of wall, with a cell size that is no positive number or an origin that is no number. A map
/// without any known cell is fine: it has no walls.
[[nodiscard]] Result<MapFeatures> build_features(const OccupancyGrid& grid);

/// From a TSD layer: its zero crossings and gradients give finer walls than the cells of Eq. 6.
[[nodiscard]] Result<MapFeatures> build_features(const TsdGrid& tsd);

}  // namespace lifeline::matching
