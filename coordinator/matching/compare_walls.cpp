#include "coordinator/matching/compare_walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

namespace {

/// Whether the wall at `p` in a, facing along `normal`, lies on one of a's that faces the same way;
/// that wall, or none.
const WallPoint* agreeing_wall(const MapFeatures& a, const Eigen::Vector2f& p,
                               const Eigen::Vector2f& normal, const WallGate& gate) {
  constexpr float kMaxAlong_m = 0.25F;
  const int index = a.field.nearest(p, normal);
  if (index == WallField::kNone) return nullptr;
  const WallPoint& other = a.walls[static_cast<std::size_t>(index)];
  const Eigen::Vector2f off = p - other.p;
  const float along = off.x() * other.normal.y() - off.y() * other.normal.x();
  const bool agrees = other.normal.dot(normal) >= gate.min_cosine &&
                      std::abs(other.normal.dot(off)) <= gate.distance_m &&
                      std::abs(along) <= kMaxAlong_m;
  return agrees ? &other : nullptr;
}

/// Removes the piece that `start` belongs to from `squares`; its length.
float take_piece(std::map<std::pair<int, int>, float>& squares, std::pair<int, int> start) {
  float length_m = 0;
  std::vector<std::pair<int, int>> open{start};
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    const auto here = squares.find({x, y});
    if (here == squares.end()) continue;
    length_m += here->second;
    squares.erase(here);
    for (const int dy : {-1, 0, 1}) {
      for (const int dx : {-1, 0, 1}) open.emplace_back(x + dx, y + dy);
    }
  }
  return length_m;
}

}  // namespace

double longest_conflict_m(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                          const MapFeatures& a) {
  constexpr float kSquare_m = 0.2F;
  const Rigid2f transform(T_a_b);
  std::map<std::pair<int, int>, float> squares;
  for (const WallPoint& wall : walls) {
    const Eigen::Vector2f p = transform * wall.p;
    if (a.field.place(p) != WallField::Place::clear) continue;
    if (agreeing_wall(a, p, transform.turn(wall.normal), kFineGate) != nullptr) continue;
    squares[{static_cast<int>(std::floor(p.x() / kSquare_m)),
             static_cast<int>(std::floor(p.y() / kSquare_m))}] += wall.length_m;
  }
  float longest_m = 0;
  while (!squares.empty()) {
    longest_m = std::max(longest_m, take_piece(squares, squares.begin()->first));
  }
  return static_cast<double>(longest_m);
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
    if (const WallPoint* const other = agreeing_wall(a, p, normal, gate)) {
      agreeing += wall.length_m;
      spread += wall.length_m * other->normal * other->normal.transpose();
      moment += wall.length_m * wall.p;
      continue;
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
