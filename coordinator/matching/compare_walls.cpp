#include "coordinator/matching/compare_walls.hpp"

#include <cmath>

#include "coordinator/matching/rigid2f.hpp"

namespace lifeline::matching {

WallFigures& WallFigures::operator+=(const WallFigures& other) {
  agreeing_m += other.agreeing_m;
  conflicting_m += other.conflicting_m;
  missed_m += other.missed_m;
  unseen_m += other.unseen_m;
  spread += other.spread;
  moment += other.moment;
  return *this;
}

WallFigures compare_walls(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                          const MapFeatures& a, const WallGate& gate) {
  const Rigid2f transform(T_a_b);
  Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
  Eigen::Vector2f moment = Eigen::Vector2f::Zero();
  float agreeing = 0, conflicting = 0, missed = 0, unseen = 0;
  for (const WallPoint& wall : walls) {
    const Eigen::Vector2f p = transform * wall.p;
    const Eigen::Vector2f normal = transform.turn(wall.normal);
    const int index = a.field.nearest(p, normal);
    if (index != WallField::kNone) {
      const WallPoint& other = a.walls[static_cast<std::size_t>(index)];
      const Eigen::Vector2f off = p - other.p;
      const float along = off.x() * other.normal.y() - off.y() * other.normal.x();
      if (other.normal.dot(normal) >= gate.min_cosine &&
          std::abs(other.normal.dot(off)) <= gate.distance_m && std::abs(along) <= 0.25F) {
        agreeing += wall.length_m;
        spread += wall.length_m * other.normal * other.normal.transpose();
        moment += wall.length_m * wall.p;
        continue;
      }
    }
    switch (a.field.place(p)) {
      case WallField::Place::clear:
        conflicting += wall.length_m;
        break;
      case WallField::Place::known:
        missed += wall.length_m;
        break;
      case WallField::Place::unknown:
        unseen += wall.length_m;
        break;
    }
  }
  return {agreeing, conflicting, missed, unseen, spread.cast<double>(), moment.cast<double>()};
}

}  // namespace lifeline::matching
