#include "agents/sources/simulator/plan.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::sources {

Eigen::AlignedBox2d FloorPlan::bounds() const {
  Eigen::AlignedBox2d box;
  for (const auto* faces : {&walls, &outline}) {
    for (const WallSegment& wall : *faces) box.extend(wall.a).extend(wall.b);
  }
  return box;
}

bool FloorPlan::is_floor(const Eigen::Vector2d& p_world) const {
  bool inside = false;
  for (const WallSegment& wall : walls) {
    // Half-open in y, so that a corner that two walls share counts once.
    if ((wall.a.y() > p_world.y()) == (wall.b.y() > p_world.y())) continue;
    const double share = (p_world.y() - wall.a.y()) / (wall.b.y() - wall.a.y());
    if (p_world.x() < wall.a.x() + share * (wall.b.x() - wall.a.x())) inside = !inside;
  }
  return inside;
}

double FloorPlan::floor_area_m2() const {
  double twice = 0.0;
  for (const WallSegment& wall : walls) {
    twice += wall.a.x() * wall.b.y() - wall.b.x() * wall.a.y();
  }
  return 0.5 * std::abs(twice);
}

double distance_to(const WallSegment& wall, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = wall.b - wall.a;
  const double length_squared = along.squaredNorm();
  if (length_squared == 0.0) return (p - wall.a).norm();
  const double share = std::clamp((p - wall.a).dot(along) / length_squared, 0.0, 1.0);
  return (p - wall.a - share * along).norm();
}

}  // namespace lifeline::sources
