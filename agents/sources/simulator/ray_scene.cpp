#include "agents/sources/simulator/ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lifeline::sources {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Walls count as this much thicker when sorted into fields, far above rounding.
constexpr double kMarginM = 1e-6;
constexpr double kMaxFields = 1e6;
/// Several fields across a room: a beam passes few walls that it does not meet.
constexpr double kFieldM = 0.4;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the wall comes within kMarginM of the square field around `centre`: separating axes.
bool touches(const WallSegment& wall, const Eigen::Vector2d& centre, double half_m) {
  const Eigen::Vector2d a = wall.a - centre, b = wall.b - centre;
  const double reach = half_m + kMarginM;
  if (std::min(a.x(), b.x()) > reach || std::max(a.x(), b.x()) < -reach) return false;
  if (std::min(a.y(), b.y()) > reach || std::max(a.y(), b.y()) < -reach) return false;
  const Eigen::Vector2d along = b - a;
  return std::abs(cross(along, a)) <= reach * (std::abs(along.x()) + std::abs(along.y()));
}

}  // namespace

double ray_to_wall(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                   const WallSegment& wall) {
  constexpr double kSlack = 1e-9;
  const Eigen::Vector2d along = wall.b - wall.a;
  const Eigen::Vector2d to_a = wall.a - origin;
  const double denominator = cross(direction, along);
  const double size = std::abs(denominator), sign = denominator < 0.0 ? -1.0 : 1.0;
  const double share = sign * cross(to_a, direction);  // along the wall, times size
  if (size == 0.0 || share < -kSlack * size || share > (1.0 + kSlack) * size) return kInfinity;
  const double distance_m = sign * cross(to_a, along) / size;
  return distance_m >= 0.0 ? distance_m : kInfinity;
}

/// A ray on its way through the fields (Amanatides and Woo 1987).
struct RayScene::Walk {
  std::array<int, 2> field{};
  std::array<int, 2> step{};
  std::array<double, 2> next_m{};   // distance at which the next column or row begins
  std::array<double, 2> delta_m{};  // between columns, between rows
  double end_m = 0.0;               // where the ray leaves the grid or reaches its greatest range
};

RayScene::RayScene(std::span<const WallSegment> walls) {
  if (walls.empty()) return;
  Eigen::AlignedBox2d box;
  for (const WallSegment& wall : walls) box.extend(wall.a).extend(wall.b);
  const Eigen::Vector2d size = box.sizes() + Eigen::Vector2d::Constant(4.0 * kMarginM);
  field_m_ = std::max(kFieldM, std::sqrt(size.prod() / kMaxFields));
  field_m_ = std::max(field_m_, size.maxCoeff() / kMaxFields);
  fields_per_m_ = 1.0 / field_m_;
  lower_ = box.min() - Eigen::Vector2d::Constant(2.0 * kMarginM);
  columns_ = static_cast<int>(size.x() * fields_per_m_) + 1;
  rows_ = static_cast<int>(size.y() * fields_per_m_) + 1;

  const auto each_field = [&](const WallSegment& wall, auto visit) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMarginM);
    const Eigen::Vector2d low = (wall.a.cwiseMin(wall.b) - margin - lower_) * fields_per_m_;
    const Eigen::Vector2d high = (wall.a.cwiseMax(wall.b) + margin - lower_) * fields_per_m_;
    for (int row = static_cast<int>(low.y()); row <= static_cast<int>(high.y()); ++row) {
      for (int column = static_cast<int>(low.x()); column <= static_cast<int>(high.x()); ++column) {
        const Eigen::Vector2d centre = lower_ + Eigen::Vector2d(column + 0.5, row + 0.5) * field_m_;
        if (touches(wall, centre, 0.5 * field_m_)) visit(field_of(column, row));
      }
    }
  };
  first_.assign(field_of(0, rows_) + 1, 0);
  for (const WallSegment& wall : walls) {
    each_field(wall, [&](std::size_t field) { ++first_[field + 1]; });
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  walls_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const WallSegment& wall : walls) {
    each_field(wall, [&](std::size_t field) { walls_[next[field]++] = wall; });
  }
}

std::size_t RayScene::field_of(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

bool RayScene::start(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                     double range_max_m, Walk& walk) const {
  const std::array<int, 2> count{columns_, rows_};
  double begin_m = 0.0;
  walk.end_m = range_max_m;
  for (int axis = 0; axis < 2; ++axis) {
    const double from = origin[axis] - lower_[axis], to = count[axis] * field_m_;
    if (direction[axis] == 0.0) {
      if (from < 0.0 || from > to) return false;
      continue;
    }
    const double at_low = -from / direction[axis], at_high = (to - from) / direction[axis];
    begin_m = std::max(begin_m, std::min(at_low, at_high));
    walk.end_m = std::min(walk.end_m, std::max(at_low, at_high));
  }
  if (!(begin_m <= walk.end_m)) return false;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double from = origin[i] - lower_[i];
    const double at = (from + begin_m * direction[i]) * fields_per_m_;
    walk.field[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, count[axis] - 1);
    walk.step[axis] = direction[i] > 0.0 ? 1 : -1;
    const bool still = direction[i] == 0.0;
    const double border = (walk.field[axis] + (direction[i] > 0.0 ? 1 : 0)) * field_m_;
    walk.next_m[axis] = still ? kInfinity : (border - from) / direction[i];
    walk.delta_m[axis] = still ? kInfinity : field_m_ / std::abs(direction[i]);
  }
  return true;
}

double RayScene::cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                      double range_max_m) const {
  Walk walk;
  double best_m = kInfinity;
  if (columns_ == 0 || !start(origin, direction, range_max_m, walk)) return best_m;
  while (true) {
    const std::size_t field = field_of(walk.field[0], walk.field[1]);
    for (std::uint32_t i = first_[field]; i < first_[field + 1]; ++i) {
      best_m = std::min(best_m, ray_to_wall(origin, direction, walls_[i]));
    }
    const std::size_t axis = walk.next_m[0] < walk.next_m[1] ? 0 : 1;
    // A wall met beyond this field may have a nearer one in front of it in the fields between.
    const double leave_m = walk.next_m[axis];
    if (best_m < leave_m - kMarginM || leave_m > walk.end_m + kMarginM) break;
    walk.field[axis] += walk.step[axis];
    if (walk.field[axis] < 0 || walk.field[axis] >= (axis == 0 ? columns_ : rows_)) break;
    walk.next_m[axis] += walk.delta_m[axis];
  }
  return best_m <= range_max_m ? best_m : kInfinity;
}

}  // namespace lifeline::sources
