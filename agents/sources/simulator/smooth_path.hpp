#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/free_space.hpp"

namespace lifeline::sources {

/// Takes the needless corners out of a way over neighbouring cells: straight pieces as long as
/// possible that come no closer to the walls than the cells they replace, or 0.55 m. First and last
/// cell stay. Returns the corners.
[[nodiscard]] std::vector<Eigen::Vector2d> pull_straight(const FreeSpace& space,
                                                         std::span<const std::size_t> way);

/// A path for walking, followed by its length.
class SmoothPath {
 public:
  /// Rounds the corners where the floor allows it and finds how fast each place may be passed: at
  /// most 1 m/s^2 sideways, 0.8 m/s^2 for braking, standing still at the end. At least two corners.
  SmoothPath(const FreeSpace& space, std::span<const Eigen::Vector2d> corners);

  [[nodiscard]] double length_m() const { return points_.back().along_m; }
  /// Beyond its ends: the ends.
  [[nodiscard]] Eigen::Vector2d at(double along_m) const;
  [[nodiscard]] double speed_limit_m_s(double along_m) const;

 private:
  struct Point {
    Eigen::Vector2d p_world;
    double along_m;
    double speed_limit_m_s;
  };
  struct Place {
    std::size_t after;  // index of the point that ends the piece
    double share;       // of the piece
  };

  void limit_speeds();
  [[nodiscard]] Place find(double along_m) const;

  std::vector<Point> points_;
};

}  // namespace lifeline::sources
