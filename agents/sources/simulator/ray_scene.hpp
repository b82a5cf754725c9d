#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/plan.hpp"

namespace lifeline::sources {

/// Distance along the ray from `origin` in the unit direction `direction` to the wall, in metres;
/// infinity where it does not meet it. A wall seen exactly edge on is not met. Ends are a nanometre
/// or so generous, so that no ray slips between two walls that share a corner.
[[nodiscard]] double ray_to_wall(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                 const WallSegment& wall);

/// Walls, sorted into a uniform grid of square fields for fast and exact ray casting.
class RayScene {
 public:
  explicit RayScene(std::span<const WallSegment> walls);

  /// Distance to the nearest wall, at most `range_max_m`; infinity where there is none.
  /// `direction` has length 1. Agrees to the bit with the least ray_to_wall() over all walls.
  [[nodiscard]] double cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                            double range_max_m) const;

 private:
  struct Walk;
  [[nodiscard]] bool start(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                           double range_max_m, Walk& walk) const;
  [[nodiscard]] std::size_t field_of(int column, int row) const;

  double field_m_ = 1.0;
  double fields_per_m_ = 1.0;
  Eigen::Vector2d lower_{0.0, 0.0};
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  // of each field, into walls_; one more at the end
  std::vector<WallSegment> walls_;    // field by field; one that crosses several stands in each
};

}  // namespace lifeline::sources
