#include "coordinator/matching/axis_spectra.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Geometry>

namespace lifeline::matching {

AxisSpectra axis_spectra(const OccupancyGrid& preprocessed, double yaw_rad) {
  const double cell_m = preprocessed.cell_size_m;
  const Eigen::Rotation2Dd turn(yaw_rad);
  Eigen::AlignedBox2d hull;
  for (const double x : {0.0, cell_m * preprocessed.columns}) {
    for (const double y : {0.0, cell_m * preprocessed.rows})
      hull.extend(turn * Eigen::Vector2d(x, y));
  }
  AxisSpectra spectra;
  spectra.first_m = hull.min();
  spectra.x.assign(static_cast<std::size_t>(hull.sizes().x() / cell_m) + 1, 0.0);
  spectra.y.assign(static_cast<std::size_t>(hull.sizes().y() / cell_m) + 1, 0.0);
  for (int row = 0; row < preprocessed.rows; ++row) {
    for (int column = 0; column < preprocessed.columns; ++column) {
      if (preprocessed.cells[preprocessed.index(column, row)] != Occupancy::occupied) continue;
      const Eigen::Vector2d p =
          (turn * (cell_m * Eigen::Vector2d(column + 0.5, row + 0.5)) - hull.min()) / cell_m;
      ++spectra.x[static_cast<std::size_t>(p.x())];
      ++spectra.y[static_cast<std::size_t>(p.y())];
    }
  }
  return spectra;
}

std::vector<int> correlation_maxima(const std::vector<double>& a, const std::vector<double>& b,
                                    int separation, std::size_t count) {
  const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
  struct Shift {
    double value;
    int shift;
  };
  std::vector<Shift> shifts;
  for (int shift = 1 - m; shift < n; ++shift) {
    double sum = 0.0;
    for (int i = std::max(0, shift); i < std::min(n, m + shift); ++i) {
      sum += a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(i - shift)];
    }
    shifts.push_back({sum, shift});
  }
  std::stable_sort(shifts.begin(), shifts.end(),
                   [](const Shift& x, const Shift& y) { return x.value > y.value; });
  std::vector<int> kept;
  for (const Shift& candidate : shifts) {
    if (kept.size() == count || candidate.value <= 0) break;
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](int other) {
      return std::abs(candidate.shift - other) >= separation;
    });
    if (apart) kept.push_back(candidate.shift);
  }
  return kept;
}

}  // namespace lifeline::matching
