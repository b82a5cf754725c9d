#include "agents/sources/simulator/ceilings.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::sources {
namespace {

/// Just behind a border, where the next area has begun.
constexpr double kBehindM = 1e-6;

/// Where along the ray the area's borders are: the distances, in front of the origin, to the lines
/// that bound it.
void add_borders(const Eigen::AlignedBox2d& area, const Eigen::Vector2d& origin,
                 const Eigen::Vector2d& direction, std::vector<double>& borders) {
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) continue;
    for (const double at : {area.min()[axis], area.max()[axis]}) {
      const double distance_m = (at - origin[axis]) / direction[axis];
      if (distance_m > 0.0) borders.push_back(distance_m);
    }
  }
}

}  // namespace

double Ceilings::height_m(const Eigen::Vector2d& p_world) const {
  for (const CeilingArea& area : areas_) {
    if (area.area.contains(p_world)) return area.height_m;
  }
  return height_m_;
}

double Ceilings::meets_m(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                         double from_m, double slope) const {
  const auto reaches = [&](double height_m) { return std::max((height_m - from_m) / slope, 0.0); };
  if (areas_.empty()) return reaches(height_m_);
  double highest_m = height_m_;
  for (const CeilingArea& area : areas_) highest_m = std::max(highest_m, area.height_m);
  const double end_m = reaches(highest_m);
  std::vector<double> borders{0.0};
  for (const CeilingArea& area : areas_) add_borders(area.area, origin, direction, borders);
  std::sort(borders.begin(), borders.end());
  for (std::size_t i = 0; i < borders.size() && borders[i] < end_m; ++i) {
    const double here_m = borders[i];
    const double there_m = reaches(height_m(origin + (here_m + kBehindM) * direction));
    // A ceiling that hangs lower than the ray is high already: its edge is met.
    if (there_m <= here_m) return here_m;
    if (i + 1 == borders.size() || there_m <= borders[i + 1]) return std::min(there_m, end_m);
  }
  return end_m;
}

}  // namespace lifeline::sources
