#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "common/grid/scan2.hpp"

namespace lifeline::support {

/// Walls without thickness, and a lidar that sees them exactly: the truth that slow and fast
/// algorithms are held against.
struct FlatWorld {
  struct Wall {
    Eigen::Vector2d a, b;
  };
  std::vector<Wall> walls;

  FlatWorld& add(double ax, double ay, double bx, double by) {
    walls.push_back({{ax, ay}, {bx, by}});
    return *this;
  }
  FlatWorld& add_box(double x0, double y0, double x1, double y1) {
    return add(x0, y0, x1, y0).add(x1, y0, x1, y1).add(x1, y1, x0, y1).add(x0, y1, x0, y0);
  }

  /// Distance to the first wall; infinite where there is none.
  [[nodiscard]] double range(const Eigen::Vector2d& from, double angle_rad) const {
    const Eigen::Vector2d d(std::cos(angle_rad), std::sin(angle_rad));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d e = wall.b - wall.a, to = wall.a - from;
      const double cross = d.x() * e.y() - d.y() * e.x();
      if (std::abs(cross) < 1e-12) continue;
      const double along = (to.x() * e.y() - to.y() * e.x()) / cross;
      const double at = (to.x() * d.y() - to.y() * d.x()) / cross;
      if (along > 1e-9 && at >= 0.0 && at <= 1.0) nearest = std::min(nearest, along);
    }
    return nearest;
  }

  /// Distance to the nearest point of any wall.
  [[nodiscard]] double distance(const Eigen::Vector2d& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d e = wall.b - wall.a;
      const double at = std::clamp((p - wall.a).dot(e) / e.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (wall.a + at * e - p).norm());
    }
    return nearest;
  }
};

struct Lidar {
  std::size_t beams = 360;
  double first_angle_rad = -std::numbers::pi;
  double step_rad = 2.0 * std::numbers::pi / 360.0;
  double max_range_m = 30.0;
  double noise_m = 0.0;
};

inline Beam2 hit_beam(double angle_rad, double range_m) {
  return {static_cast<float>(angle_rad), static_cast<float>(range_m),
          static_cast<float>(range_m * std::cos(angle_rad)),
          static_cast<float>(range_m * std::sin(angle_rad)), BeamKind::hit};
}

/// A scan of the world from `T_world_head`; Gaussian noise from `random` where the lidar has any.
inline Scan2 scan_of(const FlatWorld& world, const Pose2& T_world_head, const Lidar& lidar = {},
                     std::mt19937* random = nullptr) {
  Scan2 scan;
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t i = 0; i < lidar.beams; ++i) {
    const double angle_rad = lidar.first_angle_rad + static_cast<double>(i) * lidar.step_rad;
    double range_m = world.range(T_world_head.translation(), T_world_head.yaw_rad + angle_rad);
    if (random != nullptr) range_m += lidar.noise_m * noise(*random);
    if (range_m < lidar.max_range_m) {
      scan.beams.push_back(hit_beam(angle_rad, range_m));
    } else {
      scan.beams.push_back({static_cast<float>(angle_rad), 0.0F, 0.0F, 0.0F, BeamKind::no_return});
    }
  }
  scan.full_circle =
      static_cast<double>(lidar.beams) * lidar.step_rad > 2.0 * std::numbers::pi - 1e-6;
  return scan;
}

/// A flat of 10 m x 8 m: outer walls, an inner wall of 0.1 m with a door, a pillar and a slanted
/// wall, so that nothing about it repeats.
inline FlatWorld small_flat() {
  FlatWorld world;
  world.add_box(-4.0, -3.0, 6.0, 5.0);
  world.add_box(2.0, -3.0, 2.1, 1.5);
  world.add_box(2.0, 2.6, 2.1, 5.0);
  world.add_box(-2.2, 2.0, -1.6, 2.7);
  world.add(-4.0, -1.0, -2.5, -3.0);
  return world;
}

}  // namespace lifeline::support
