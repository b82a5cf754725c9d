#include "coordinator/matching/overlap.hpp"

#include <cmath>

#include "coordinator/matching/known_cells.hpp"

namespace lifeline::matching {

double Overlap::s_overlapping(double grid_cells) const {
  return grid_cells > 0 ? static_cast<double>(agreeing) / grid_cells : 0.0;
}

double Overlap::acceptance_index() const {
  const std::size_t both = agreeing + disagreeing;
  return both == 0 ? 0.0 : static_cast<double>(agreeing) / static_cast<double>(both);
}

Overlap count_overlap(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b) {
  const auto c = static_cast<float>(std::cos(T_a_b.yaw_rad));
  const auto s = static_cast<float>(std::sin(T_a_b.yaw_rad));
  const auto columns = static_cast<float>(a.columns), rows = static_cast<float>(a.rows);
  Overlap overlap;
  for (int row = 0; row < b.rows; ++row) {
    const double y = row + 0.5;
    const auto x0 = static_cast<float>(T_a_b.x_m / a.cell_size_m) - s * static_cast<float>(y);
    const auto y0 = static_cast<float>(T_a_b.y_m / a.cell_size_m) + c * static_cast<float>(y);
    const Occupancy* const cells = b.cells.data() + b.index(0, row);
    for_known_cells(cells, b.columns, [&](int column) {
      const float along = static_cast<float>(column) + 0.5F;
      const float ax = x0 + c * along, ay = y0 + s * along;
      if (!(ax >= 0 && ay >= 0 && ax < columns && ay < rows)) return;
      const Occupancy other = a.cells[a.index(static_cast<int>(ax), static_cast<int>(ay))];
      if (other == Occupancy::unknown) return;
      ++(other == cells[column] ? overlap.agreeing : overlap.disagreeing);
    });
  }
  return overlap;
}

}  // namespace lifeline::matching
