#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/plan.hpp"

namespace lifeline::sources {

/// How high the ceiling is from place to place. Between two heights there is a vertical step.
class Ceilings {
 public:
  /// `height_m` above the floor wherever none of `areas` is.
  explicit Ceilings(double height_m, std::vector<CeilingArea> areas = {})
      : height_m_(height_m), areas_(std::move(areas)) {}

  [[nodiscard]] double height_m(const Eigen::Vector2d& p_world) const;

  /// Where a ray that rises meets the ceiling: metres from `origin` in the plane. It begins
  /// `from_m` above the floor, runs along the unit vector `direction` and rises by `slope` > 0 per
  /// metre.
  [[nodiscard]] double meets_m(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                               double from_m, double slope) const;

 private:
  double height_m_;
  std::vector<CeilingArea> areas_;
};

}  // namespace lifeline::sources
