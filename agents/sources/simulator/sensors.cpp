#include "agents/sources/simulator/sensors.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace lifeline::sources {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

}  // namespace

sensing::RawScan SimulatedLidar::sweep(const RayScene& scene, const Motion& T_world_head,
                                       double t_s) {
  sensing::RawScan scan;
  const double step_s = options_.takes_time ? 1.0 / (options_.turns_per_s * options_.beams) : 0.0;
  scan.sweep_time = from_seconds(step_s * (options_.beams - 1));
  scan.first_angle_rad = -kPi;
  scan.angle_step_rad = 2.0 * kPi / options_.beams;
  scan.range_min_m = options_.range_min_m;
  scan.range_max_m = options_.range_max_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  Pose2 pose = T_world_head(t_s);
  scan.T_world_head_truth = pose;
  for (int beam = 0; beam < options_.beams; ++beam) {
    if (options_.takes_time) pose = T_world_head(t_s + step_s * beam);
    const double angle = pose.yaw_rad + scan.first_angle_rad + scan.angle_step_rad * beam;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    scan.ranges_m.push_back(read(scene.cast(pose.translation(), direction, options_.range_max_m)));
  }
  return scan;
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
    : noise_(seed), zero_rad_(Draw(stir(seed, 0)).between(-kPi, kPi)) {}

sensing::Attitude SimulatedAhrs::measure(double true_yaw_rad, double dt_s) {
  zero_rad_ += kDriftSigmaDegPerRootS * kDegree * std::sqrt(dt_s) * noise_.next();
  const double white_rad = kWhiteSigmaDeg * kDegree * noise_.next();
  return {.roll_rad = 0.0,
          .pitch_rad = 0.0,
          .yaw_rad = normalise_angle(true_yaw_rad + zero_rad_ + white_rad)};
}

}  // namespace lifeline::sources
