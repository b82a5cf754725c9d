#include "tests/support/simulated_maps.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "agents/sources/portable_noise.hpp"
#include "agents/sources/simulator/rectilinear.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_update.hpp"

namespace lifeline::test {
namespace {

using sources::Box;

constexpr int kBeams = 720;
constexpr double kRange_m = 20.0;
constexpr double kScanEvery_s = 0.5;
constexpr double kRangeSigma_m = 0.01;
constexpr double kPlaceSigma_m = 0.015;
constexpr double kYawSigma_rad = 0.15 * std::numbers::pi / 180.0;
constexpr double kWall_m = 0.15;
constexpr double kDoor_m = 1.0;

Box box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

Scan2 scan_from(const sources::RayScene& scene, const Pose2& T_world_head,
                sources::PortableNoise& noise) {
  Scan2 scan;
  scan.full_circle = true;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = 2 * std::numbers::pi * i / kBeams;
    const double bearing = T_world_head.yaw_rad + angle;
    const double range =
        scene.cast(T_world_head.translation(), {std::cos(bearing), std::sin(bearing)}, kRange_m) +
        kRangeSigma_m * noise.next();
    Beam2 beam{.angle_rad = static_cast<float>(angle), .kind = BeamKind::no_return};
    if (std::isfinite(range)) {
      beam.kind = BeamKind::hit;
      beam.range_m = static_cast<float>(range);
      beam.x_m = static_cast<float>(range * std::cos(angle));
      beam.y_m = static_cast<float>(range * std::sin(angle));
    }
    scan.beams.push_back(beam);
  }
  return scan;
}

/// Where a helmet believes it is that errs in every heading: the steps of the walk, turned.
class DriftingPose {
 public:
  explicit DriftingPose(double drift_rad_per_m) : drift_rad_per_m_(drift_rad_per_m) {}

  Pose2 at(const Pose2& T_world_head) {
    if (started_) {
      const Pose2 step = before_.inverse() * T_world_head;
      const double way_m = step.translation().norm();
      believed_ = believed_ * step;
      believed_.yaw_rad = normalise_angle(believed_.yaw_rad + drift_rad_per_m_ * way_m);
    } else {
      believed_ = T_world_head;
      started_ = true;
    }
    before_ = T_world_head;
    return believed_;
  }

 private:
  double drift_rad_per_m_;
  bool started_ = false;
  Pose2 before_, believed_;
};

}  // namespace

SimulatedFloor::SimulatedFloor(sources::FloorPlan plan, sources::FreeSpace space)
    : plan_(std::move(plan)),
      scene_(plan_.walls),
      space_(std::make_unique<sources::FreeSpace>(std::move(space))) {}

Result<SimulatedFloor> SimulatedFloor::make(sources::FloorPlan plan) {
  auto space = sources::FreeSpace::make(plan);
  if (!space) return forward_error(space);
  return SimulatedFloor(std::move(plan), *std::move(space));
}

TsdGrid SimulatedFloor::map(const SimulatedView& view) const {
  const GridGeometry geometry;
  TsdGrid grid(geometry);
  TsdUpdater updater(geometry, PushConfig{});
  sources::Walk walk(*space_, view.walker);
  sources::PortableNoise noise(view.noise_seed);
  DriftingPose drifting(view.drift_rad_per_m);
  const Pose2 T_map_world = view.T_world_map.inverse();
  for (double t_s = view.from_s; t_s < view.until_s; t_s += kScanEvery_s) {
    const Pose2 T_world_head = walk.pose_at(t_s);
    const Scan2 scan = scan_from(scene_, T_world_head, noise);
    Pose2 pushed = T_map_world * drifting.at(T_world_head);
    pushed.x_m += kPlaceSigma_m * noise.next();
    pushed.y_m += kPlaceSigma_m * noise.next();
    pushed.yaw_rad += kYawSigma_rad * noise.next();
    updater.push(extract_surface(scan), pushed, 1.0, grid);
  }
  return grid;
}

sources::FloorPlan mirrored(const sources::FloorPlan& plan) {
  sources::FloorPlan mirror;
  mirror.name = plan.name + ", mirrored";
  // From b to a, so that the floor stays on the same side.
  for (const auto& wall : plan.walls) {
    mirror.walls.push_back({{-wall.b.x(), wall.b.y()}, {-wall.a.x(), wall.a.y()}});
  }
  return mirror;
}

sources::FloorPlan repeated_rooms(int rooms, double room_width_m, double room_depth_m) {
  constexpr double kCorridor_m = 2.0;
  const double pitch_m = room_width_m + kWall_m;
  std::vector<Box> floors{box(0, 0, rooms * pitch_m - kWall_m, kCorridor_m)};
  for (int i = 0; i < rooms; ++i) {
    const double x = i * pitch_m, door = x + 0.5 * room_width_m;
    const double below = -kWall_m, above = kCorridor_m + kWall_m;
    floors.push_back(box(x, below - room_depth_m, x + room_width_m, below));
    floors.push_back(box(door - kDoor_m / 2, below, door + kDoor_m / 2, 0));
    floors.push_back(box(x, above, x + room_width_m, above + room_depth_m));
    floors.push_back(box(door - kDoor_m / 2, kCorridor_m, door + kDoor_m / 2, above));
  }
  sources::FloorPlan plan;
  plan.name = "repeated rooms";
  plan.walls = sources::border_of(floors, {});
  return plan;
}

sources::FloorPlan symmetric_hall(double side_m, double room_m, double oblong_m) {
  const double x = (side_m + oblong_m) / 2, y = side_m / 2, r = room_m / 2, d = kDoor_m / 2;
  std::vector<Box> floors{box(-x, -y, x, y)};
  for (const double side : {-1.0, 1.0}) {
    const auto across = [&](double near_m, double far_m, double half_m) {
      floors.push_back(side > 0 ? box(near_m, -half_m, far_m, half_m)
                                : box(-far_m, -half_m, -near_m, half_m));
    };
    const auto along = [&](double near_m, double far_m, double half_m) {
      floors.push_back(side > 0 ? box(-half_m, near_m, half_m, far_m)
                                : box(-half_m, -far_m, half_m, -near_m));
    };
    across(x, x + kWall_m, d);
    across(x + kWall_m, x + kWall_m + room_m, r);
    along(y, y + kWall_m, d);
    along(y + kWall_m, y + kWall_m + room_m, r);
  }
  sources::FloorPlan plan;
  plan.name = "symmetric hall";
  plan.walls = sources::border_of(floors, {});
  return plan;
}

}  // namespace lifeline::test
