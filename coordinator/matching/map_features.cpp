#include "coordinator/matching/map_features.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/base/check.hpp"
#include "coordinator/matching/known_cells.hpp"
#include "coordinator/matching/preprocess.hpp"

namespace lifeline::matching {
namespace {

constexpr std::size_t kMaxWallPoints = 400'000;

Result<void> check_size(const OccupancyGrid& grid) {
  if (!std::isfinite(grid.cell_size_m) || grid.cell_size_m <= 0) {
    return fail(ErrorCode::bad_data, "the map's cell size is {} m: it must be a positive number",
                grid.cell_size_m);
  }
  if (!grid.origin_m.allFinite()) {
    return fail(ErrorCode::bad_data, "the map's origin ({}, {}) is not a number", grid.origin_m.x(),
                grid.origin_m.y());
  }
  if (auto size = check_grid_size(grid.columns, grid.rows); !size) return size;
  LIFELINE_CHECK(grid.columns >= 0 && grid.rows >= 0 &&
                 grid.cells.size() ==
                     static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  return {};
}

/// `grid` less the free cells that few beams crossed. By a small error of the heading a beam that
/// came far along a corridor has crossed a wall: what it saw free contradicts no other map.
OccupancyGrid well_seen(const OccupancyGrid& grid, const TsdGrid& tsd) {
  constexpr float kMinWeight = 3.0F;
  OccupancyGrid seen = grid;
  const CellIndex corner =
      tsd.cell_at(grid.origin_m + Eigen::Vector2d::Constant(0.5 * grid.cell_size_m));
  for (int row = 0; row < grid.rows; ++row) {
    const std::size_t first = grid.index(0, row);
    for_known_cells(grid.cells.data() + first, grid.columns, [&](int column) {
      Occupancy& cell = seen.cells[first + static_cast<std::size_t>(column)];
      if (cell == Occupancy::free &&
          tsd.cell({corner.x + column, corner.y + row}).weight_value() < kMinWeight) {
        cell = Occupancy::unknown;
      }
    });
  }
  return seen;
}

/// Completes the features from the raw `cropped` grid, its dense wall points, and what of it may
/// contradict another map.
Result<MapFeatures> complete(const OccupancyGrid& cropped, const std::vector<WallPoint>& dense,
                             const OccupancyGrid& well_seen) {
  MapFeatures features;
  features.cell_size_m = cropped.cell_size_m;
  features.origin_map_m = cropped.origin_m;
  features.walls = thin_out(dense, kWallSpacing_m);
  if (features.walls.size() > kMaxWallPoints) {
    return fail(ErrorCode::unsupported,
                "the map has {} pieces of wall, more than {}: not a building",
                features.walls.size(), kMaxWallPoints);
  }
  features.skeleton = thin_out(features.walls, kSkeletonSpacing_m);
  features.field = WallField(well_seen, features.walls);
  features.oriented = oriented_spectrum(features.walls);
  features.filtered = filter_noise(cropped);
  for (const WallPoint& wall : features.walls) features.wall_m += wall.length_m;
  features.known_m2 =
      static_cast<double>(known_cells(cropped)) * cropped.cell_size_m * cropped.cell_size_m;
  return features;
}

OccupancyGrid mirrored(const OccupancyGrid& grid) {
  OccupancyGrid mirror = grid;
  for (int row = 0; row < grid.rows; ++row) {
    const auto first = mirror.cells.begin() + static_cast<std::ptrdiff_t>(grid.index(0, row));
    std::reverse(first, first + grid.columns);
  }
  return mirror;
}

std::vector<WallPoint> mirrored(std::vector<WallPoint> walls, const OccupancyGrid& grid) {
  const auto width_m = static_cast<float>(grid.columns * grid.cell_size_m);
  for (WallPoint& wall : walls) {
    wall.p.x() = width_m - wall.p.x();
    wall.normal.x() = -wall.normal.x();
  }
  return walls;
}

Result<MapFeatures> complete_with_mirror(const OccupancyGrid& cropped,
                                         const std::vector<WallPoint>& dense,
                                         const OccupancyGrid& well_seen) {
  auto features = complete(cropped, dense, well_seen);
  if (!features) return features;
  auto mirror = complete(mirrored(cropped), mirrored(dense, cropped), mirrored(well_seen));
  if (!mirror) return mirror;
  features->mirror = std::make_shared<const MapFeatures>(*std::move(mirror));
  return features;
}

}  // namespace

Result<MapFeatures> build_features(const OccupancyGrid& grid) {
  if (const auto checked = check_size(grid); !checked) return forward_error(checked);
  const OccupancyGrid cropped = crop_to_known(grid, kWallMargin);
  return complete_with_mirror(cropped, wall_points(cropped), cropped);
}

Result<MapFeatures> build_features(const TsdGrid& tsd) {
  const auto grid = to_occupancy(tsd);
  if (!grid) return forward_error(grid);
  if (const auto checked = check_size(*grid); !checked) return forward_error(checked);
  const OccupancyGrid cropped = crop_to_known(*grid, kWallMargin);
  auto features =
      complete_with_mirror(cropped, wall_points(tsd, cropped.origin_m), well_seen(cropped, tsd));
  if (features) features->weighed = true;
  return features;
}

}  // namespace lifeline::matching
