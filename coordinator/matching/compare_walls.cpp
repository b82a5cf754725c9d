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

std::pair<int, int> square_at(const Eigen::Vector2f& p, float side_m) {
  return {static_cast<int>(std::floor(p.x() / side_m)),
          static_cast<int>(std::floor(p.y() / side_m))};
}

/// Calls visit(wall, p, normal), both in a's frame, for the wall of b that lies in a's clear space.
template <typename Visit>
void for_contradicting(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                       const MapFeatures& a, Visit visit) {
  const Rigid2f transform(T_a_b);
  for (const WallPoint& wall : walls) {
    const Eigen::Vector2f p = transform * wall.p;
    if (a.field.place(p) != WallField::Place::clear) continue;
    const Eigen::Vector2f normal = transform.turn(wall.normal);
    if (agreeing_wall(a, p, normal, kFineGate) == nullptr) visit(wall, p, normal);
  }
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

/// The wall of a map by squares as wide as the reach, so that few are looked at.
class DisplacedWallFinder {
 public:
  explicit DisplacedWallFinder(const std::vector<WallPoint>& walls) {
    for (const WallPoint& wall : walls) squares_[square_at(wall.p, kReach_m)].push_back(&wall);
  }

  /// Whether there is wall beside `p` that faces like `normal`.
  [[nodiscard]] bool finds(const Eigen::Vector2f& p, const Eigen::Vector2f& normal) const {
    const auto [x, y] = square_at(p, kReach_m);
    for (const int dy : {-1, 0, 1}) {
      for (const int dx : {-1, 0, 1}) {
        const auto square = squares_.find({x + dx, y + dy});
        if (square == squares_.end()) continue;
        for (const WallPoint* const wall : square->second) {
          if (is_beside(*wall, p, normal)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr float kReach_m = 1.0F;

  static bool is_beside(const WallPoint& wall, const Eigen::Vector2f& p,
                        const Eigen::Vector2f& normal) {
    constexpr float kMaxAlong_m = 0.5F, kMinCosine = 0.8F;
    const Eigen::Vector2f off = p - wall.p;
    const float along = off.x() * wall.normal.y() - off.y() * wall.normal.x();
    return wall.normal.dot(normal) >= kMinCosine && std::abs(along) <= kMaxAlong_m &&
           std::abs(wall.normal.dot(off)) <= kReach_m;
  }

  std::map<std::pair<int, int>, std::vector<const WallPoint*>> squares_;
};

}  // namespace

double displaced_conflict_m(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                            const MapFeatures& a) {
  const DisplacedWallFinder finder(a.skeleton);
  double displaced_m = 0.0;
  for_contradicting(walls, T_a_b, a, [&](const WallPoint& wall, const auto& p, const auto& normal) {
    if (finder.finds(p, normal)) displaced_m += static_cast<double>(wall.length_m);
  });
  return displaced_m;
}

double longest_conflict_m(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                          const MapFeatures& a) {
  constexpr float kSquare_m = 0.2F;
  std::map<std::pair<int, int>, float> squares;
  for_contradicting(walls, T_a_b, a, [&](const WallPoint& wall, const auto& p, const auto&) {
    squares[square_at(p, kSquare_m)] += wall.length_m;
  });
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
