#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"

namespace lifeline::matching {

/// The x and y spectra of a map that was turned: how many occupied cells each column and each row
/// of the turned map holds.
struct AxisSpectra {
  std::vector<double> x, y;
  Eigen::Vector2d first_m{0.0, 0.0};  ///< where column 0 and row 0 begin, in the turned frame
};

/// `preprocessed` is turned by `yaw_rad` about its corner; columns are as wide as its cells.
[[nodiscard]] AxisSpectra axis_spectra(const OccupancyGrid& preprocessed, double yaw_rad);

/// The shifts of `b` (in elements, may be negative) at which its correlation with `a` has its
/// highest local maxima, from high to low, at most `count`, at least `separation` apart.
[[nodiscard]] std::vector<int> correlation_maxima(const std::vector<double>& a,
                                                  const std::vector<double>& b, int separation,
                                                  std::size_t count);

}  // namespace lifeline::matching
