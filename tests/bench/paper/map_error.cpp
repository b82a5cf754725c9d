#include "tests/bench/paper/map_error.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "coordinator/matching/wall_points.hpp"

namespace lifeline::bench {
namespace {

constexpr double kMostM = 0.5;
constexpr double kNearM = 0.15;
constexpr float kSpacingM = 0.1F;

using sources::WallSegment;

/// All that may stand in a map: doors were closed at times.
std::vector<WallSegment> all_surfaces(const sources::FloorPlan& plan) {
  std::vector<WallSegment> surfaces = plan.walls;
  surfaces.insert(surfaces.end(), plan.panes.begin(), plan.panes.end());
  for (const sources::Doorway& door : plan.doorways) surfaces.push_back({door.a, door.b});
  return surfaces;
}

std::vector<Eigen::Vector2d> map_points(const TsdGrid& map, const Pose2& T_world_map) {
  std::vector<Eigen::Vector2d> points;
  const auto walls =
      matching::thin_out(matching::wall_points(map, Eigen::Vector2d::Zero()), kSpacingM);
  points.reserve(walls.size());
  for (const auto& wall : walls) points.push_back(T_world_map * wall.p.cast<double>());
  return points;
}

/// Points of the plan's opaque faces, evenly spaced.
std::vector<Eigen::Vector2d> plan_points(const sources::FloorPlan& plan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    if (!plan.materials.empty() && plan.materials[i] != sources::Material::plain) continue;
    const Eigen::Vector2d along = plan.walls[i].b - plan.walls[i].a;
    const int count = static_cast<int>(along.norm() / static_cast<double>(kSpacingM));
    for (int k = 0; k < count; ++k) {
      points.push_back(plan.walls[i].a + along * ((k + 0.5) / count));
    }
  }
  return points;
}

/// Whether one of the points lies within kNearM.
class Nearby {
 public:
  explicit Nearby(std::vector<Eigen::Vector2d> points) : points_(std::move(points)) {
    std::sort(points_.begin(), points_.end(),
              [](const auto& p, const auto& q) { return p.x() < q.x(); });
  }
  [[nodiscard]] bool any(const Eigen::Vector2d& p) const {
    auto next = std::lower_bound(points_.begin(), points_.end(), p.x() - kNearM,
                                 [](const auto& q, double x) { return q.x() < x; });
    for (; next != points_.end() && next->x() <= p.x() + kNearM; ++next) {
      if ((*next - p).norm() <= kNearM) return true;
    }
    return false;
  }

 private:
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace

MapError map_error(const TsdGrid& map, const Pose2& T_world_map, const sources::FloorPlan& plan) {
  MapError error;
  const std::vector<WallSegment> surfaces = all_surfaces(plan);
  std::vector<Eigen::Vector2d> points = map_points(map, T_world_map);
  for (const Eigen::Vector2d& p : points) {
    double off_m = kMostM;
    for (const WallSegment& surface : surfaces) off_m = std::min(off_m, distance_to(surface, p));
    error.wall_m += off_m;
    error.astray_share += off_m > kNearM ? 1.0 : 0.0;
  }
  if (!points.empty()) {
    error.wall_m /= static_cast<double>(points.size());
    error.astray_share /= static_cast<double>(points.size());
  }
  const Nearby nearby(std::move(points));
  const std::vector<Eigen::Vector2d> wanted = plan_points(plan);
  const auto found =
      std::count_if(wanted.begin(), wanted.end(), [&](const auto& p) { return nearby.any(p); });
  error.complete_share = static_cast<double>(found) / static_cast<double>(wanted.size());
  return error;
}

}  // namespace lifeline::bench
