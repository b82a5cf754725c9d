#include "agents/sources/simulator/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace lifeline::sources {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

}  // namespace

sensing::RawScan SimulatedLidar::sweep(const RayScene& scene, const Motion& head, double t_s,
                                       std::span<const WallSegment> more_walls) {
  sensing::RawScan scan;
  const double step_s = options_.takes_time ? 1.0 / (options_.turns_per_s * options_.beams) : 0.0;
  scan.sweep_time = from_seconds(step_s * (options_.beams - 1));
  scan.first_angle_rad = -kPi;
  scan.angle_step_rad = 2.0 * kPi / options_.beams;
  scan.range_min_m = options_.range_min_m;
  scan.range_max_m = options_.range_max_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  HeadPose pose = head(t_s);
  scan.T_world_head_truth = pose.T_world_head;
  for (int beam = 0; beam < options_.beams; ++beam) {
    if (options_.takes_time) pose = head(t_s + step_s * beam);
    const double turned_rad = scan.angle_step_rad * beam;
    scan.ranges_m.push_back(read(cast(scene, more_walls, pose, turned_rad)));
  }
  return scan;
}

double SimulatedLidar::cast(const RayScene& scene, std::span<const WallSegment> more_walls,
                            const HeadPose& head, double turned_rad) const {
  const Pose2& pose = head.T_world_head;
  // Of the beam: its direction in the plane, the share of its length that lies in the plane, and
  // how much it rises per metre of its length.
  Eigen::Vector2d direction;
  double flat = 1.0, rise = 0.0;
  if (head.roll_rad == 0.0 && head.pitch_rad == 0.0) {
    const double angle = pose.yaw_rad - kPi + turned_rad;
    direction = {std::cos(angle), std::sin(angle)};
  } else {
    const double angle = turned_rad - kPi;
    const Eigen::Vector3d along = Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()) *
                                  (Eigen::AngleAxisd(head.pitch_rad, Eigen::Vector3d::UnitY()) *
                                   (Eigen::AngleAxisd(head.roll_rad, Eigen::Vector3d::UnitX()) *
                                    Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)));
    flat = along.head<2>().norm();
    rise = along.z();
    direction = along.head<2>() / flat;
  }
  double wall_m = scene.cast(pose.translation(), direction, options_.range_max_m * flat);
  for (const WallSegment& wall : more_walls) {
    wall_m = std::min(wall_m, ray_to_wall(pose.translation(), direction, wall));
  }
  double range_m = wall_m / flat;
  if (rise < 0.0) range_m = std::min(range_m, options_.height_m / -rise);
  if (rise > 0.0) range_m = std::min(range_m, (options_.ceiling_m - options_.height_m) / rise);
  return range_m <= options_.range_max_m ? range_m : std::numeric_limits<double>::infinity();
}

float SimulatedLidar::read(double true_range_m) {
  // Drawn for every beam, hit or not, so that one beam's fate does not shift the others' noise.
  const double noise = noise_.next();
  const bool dropped = luck_.uniform() < options_.dropout_share;
  if (dropped) return 0.0F;
  if (!std::isfinite(true_range_m)) return std::numeric_limits<float>::infinity();
  const double sigma_m = options_.noise_m * (1.0 + 0.1 * true_range_m);
  const double range_m = true_range_m + sigma_m * noise;
  const double rounded_m = std::round(range_m / options_.resolution_m) * options_.resolution_m;
  if (rounded_m < options_.range_min_m) return 0.0F;
  if (rounded_m > options_.range_max_m) return std::numeric_limits<float>::infinity();
  return static_cast<float>(rounded_m);
}

SimulatedAhrs::SimulatedAhrs(std::uint64_t seed)
    : noise_(seed), tilt_noise_(stir(seed, 1)), zero_rad_(Draw(stir(seed, 0)).between(-kPi, kPi)) {}

sensing::Attitude SimulatedAhrs::measure(double true_yaw_rad, double dt_s) {
  zero_rad_ += kDriftSigmaDegPerRootS * kDegree * std::sqrt(dt_s) * noise_.next();
  const double white_rad = kWhiteSigmaDeg * kDegree * noise_.next();
  return {.roll_rad = 0.0,
          .pitch_rad = 0.0,
          .yaw_rad = normalise_angle(true_yaw_rad + zero_rad_ + white_rad)};
}

sensing::Attitude SimulatedAhrs::measure_leaning(const HeadPose& head, double dt_s) {
  sensing::Attitude attitude = measure(head.T_world_head.yaw_rad, dt_s);
  attitude.roll_rad = head.roll_rad + kTiltSigmaDeg * kDegree * tilt_noise_.next();
  attitude.pitch_rad = head.pitch_rad + kTiltSigmaDeg * kDegree * tilt_noise_.next();
  return attitude;
}

}  // namespace lifeline::sources
