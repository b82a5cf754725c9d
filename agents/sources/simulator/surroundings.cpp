#include "agents/sources/simulator/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lifeline::sources {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double first_wall_m(const Surroundings& around, const LidarBeam& beam, double range_max_m) {
  double wall_m = around.walls.cast(beam.origin, beam.direction, range_max_m * beam.flat);
  for (const WallSegment& wall : around.more_walls) {
    wall_m = std::min(wall_m, ray_to_wall(beam.origin, beam.direction, wall));
  }
  return wall_m;
}

/// In the plane, to floor or ceiling; infinity for a level beam.
double floor_or_ceiling_m(const Surroundings& around, const LidarBeam& beam) {
  if (beam.rise < 0.0) return beam.flat * beam.height_m / -beam.rise;
  if (beam.rise == 0.0 || around.ceilings == nullptr) return kInfinity;
  return around.ceilings->meets_m(beam.origin, beam.direction, beam.height_m,
                                  beam.rise / beam.flat);
}

void note_panes(std::span<const WallSegment> panes, const LidarBeam& beam, double before_m,
                Echoes& echoes) {
  for (const WallSegment& pane : panes) {
    const double pane_m = ray_to_wall(beam.origin, beam.direction, pane);
    if (!(pane_m < before_m)) continue;
    ++echoes.panes;
    if (pane_m / beam.flat >= echoes.pane_m) continue;
    echoes.pane_m = pane_m / beam.flat;
    const Eigen::Vector2d along = (pane.b - pane.a).normalized();
    const double across = along.x() * beam.direction.y() - along.y() * beam.direction.x();
    echoes.pane_cosine = std::abs(across) * beam.flat;  // panes are upright
  }
}

}  // namespace

LidarBeam beam_of(const HeadPose& head, double turned_rad, double height_m) {
  const Pose2& pose = head.T_world_head;
  LidarBeam beam;
  beam.origin = pose.translation();
  beam.height_m = height_m + head.raised_m;
  if (head.roll_rad == 0.0 && head.pitch_rad == 0.0) {
    const double angle = pose.yaw_rad - std::numbers::pi + turned_rad;
    beam.direction = {std::cos(angle), std::sin(angle)};
    return beam;
  }
  const double angle = turned_rad - std::numbers::pi;
  const Eigen::Vector3d along = Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()) *
                                (Eigen::AngleAxisd(head.pitch_rad, Eigen::Vector3d::UnitY()) *
                                 (Eigen::AngleAxisd(head.roll_rad, Eigen::Vector3d::UnitX()) *
                                  Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)));
  beam.flat = along.head<2>().norm();
  beam.rise = along.z();
  beam.direction = along.head<2>() / beam.flat;
  return beam;
}

double ray_to_person(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                     const Eigen::Vector2d& person) {
  const Eigen::Vector2d to_person = person - origin;
  const double along_m = to_person.dot(direction);
  const double aside_sq = to_person.squaredNorm() - along_m * along_m;
  const double half_sq = kPersonRadiusM * kPersonRadiusM - aside_sq;
  if (half_sq < 0.0) return kInfinity;
  const double distance_m = along_m - std::sqrt(half_sq);
  return distance_m >= 0.0 ? distance_m : kInfinity;
}

Echoes cast(const Surroundings& around, const LidarBeam& beam, double range_max_m) {
  double flat_m = first_wall_m(around, beam, range_max_m);
  Echoes echoes;
  if (around.black != nullptr && std::isfinite(flat_m)) {
    // The same arithmetic on the same wall: equal to the bit, where it is the nearest.
    echoes.swallowed = around.black->cast(beam.origin, beam.direction, flat_m) <= flat_m;
  }
  const auto shorten = [&](double other_m) {
    if (!(other_m < flat_m)) return;
    flat_m = other_m;
    echoes.swallowed = false;
  };
  for (const Eigen::Vector2d& person : around.people) {
    shorten(ray_to_person(beam.origin, beam.direction, person));
  }
  shorten(floor_or_ceiling_m(around, beam));
  note_panes(around.panes, beam, flat_m, echoes);
  note_panes(around.closed_glass, beam, flat_m, echoes);
  const double end_m = flat_m / beam.flat;
  if (end_m <= range_max_m)
    echoes.end_m = end_m;
  else
    echoes.swallowed = false;
  return echoes;
}

}  // namespace lifeline::sources
