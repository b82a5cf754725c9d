#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::test {

/// A piece of wall, in the world.
struct DrawnWall {
  Eigen::Vector2d from, to;
};

/// A building of straight walls 0.1 m thick; whatever lies within a room's rectangle is free.
struct DrawnBuilding {
  std::vector<DrawnWall> walls;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> rooms;  ///< lower left, upper right

  void add_room(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    rooms.push_back({low, high});
    walls.push_back({low, {high.x(), low.y()}});
    walls.push_back({{high.x(), low.y()}, high});
    walls.push_back({high, {low.x(), high.y()}});
    walls.push_back({{low.x(), high.y()}, low});
  }
};

inline double distance_to(const DrawnWall& wall, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = wall.to - wall.from;
  const double t = std::clamp((p - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - wall.from - t * along).norm();
}

/// The occupancy map that a flawless helmet would make whose map frame lies at `T_world_map`, of a
/// square of `side_m`.
inline OccupancyGrid draw_map(const DrawnBuilding& building, const Pose2& T_world_map,
                              double side_m) {
  OccupancyGrid grid;
  grid.origin_m = {-side_m / 2, -side_m / 2};
  grid.columns = grid.rows = static_cast<int>(std::lround(side_m / grid.cell_size_m));
  grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                    Occupancy::unknown);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d p_map =
          grid.origin_m + Eigen::Vector2d(column + 0.5, row + 0.5) * grid.cell_size_m;
      const Eigen::Vector2d p_world = T_world_map * p_map;
      auto& cell = grid.cells[grid.index(column, row)];
      if (std::any_of(building.rooms.begin(), building.rooms.end(), [&](const auto& room) {
            return (p_world.array() > room.first.array()).all() &&
                   (p_world.array() < room.second.array()).all();
          })) {
        cell = Occupancy::free;
      }
      if (std::any_of(building.walls.begin(), building.walls.end(),
                      [&](const DrawnWall& wall) { return distance_to(wall, p_world) < 0.05; })) {
        cell = Occupancy::occupied;
      }
    }
  }
  return grid;
}

/// Rooms of differing sizes along a corridor, with furniture: looks the same from no two places.
inline DrawnBuilding uneven_building() {
  DrawnBuilding building;
  building.add_room({0.0, 0.0}, {14.0, 1.8});
  building.add_room({0.0, 1.8}, {4.0, 6.5});
  building.add_room({4.0, 1.8}, {9.5, 5.0});
  building.add_room({9.5, 1.8}, {14.0, 8.0});
  building.add_room({2.0, -4.2}, {7.0, 0.0});
  building.add_room({7.0, -2.9}, {14.0, 0.0});
  building.walls.push_back({{1.0, 4.0}, {2.2, 4.0}});
  building.walls.push_back({{11.0, 5.0}, {11.0, 6.7}});
  building.walls.push_back({{9.0, -1.2}, {10.5, -1.2}});
  building.walls.push_back({{5.0, -2.0}, {5.0, -3.1}});
  return building;
}

}  // namespace lifeline::test
