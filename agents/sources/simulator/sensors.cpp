#include "agents/sources/simulator/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

/// Glass: of 8 deg, and the share of echoes that come back through a pane.
constexpr double kMirrorCosine = 0.990268;
constexpr double kPassesShare = 6.0 / 7.0;
/// Smoke: what share of lost echoes it sends back itself, and from how deep, of the sight.
constexpr double kSmokeShare = 0.3;
constexpr double kSmokeDepth = 0.2;

}  // namespace

sensing::RawScan SimulatedLidar::sweep(const Surroundings& around, const Motion& head, double t_s) {
  sensing::RawScan scan;
  const double step_s = options_.takes_time ? 1.0 / (options_.turns_per_s * options_.beams) : 0.0;
  scan.sweep_time = from_seconds(step_s * (options_.beams - 1));
  scan.first_angle_rad = -std::numbers::pi;
  scan.angle_step_rad = 2.0 * std::numbers::pi / options_.beams;
  scan.range_min_m = options_.range_min_m;
  scan.range_max_m = options_.range_max_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  Surroundings below_ceiling = around;
  if (below_ceiling.ceilings == nullptr) below_ceiling.ceilings = &plain_ceiling_;
  HeadPose pose = head(t_s);
  scan.T_world_head_truth = pose.T_world_head;
  for (int beam = 0; beam < options_.beams; ++beam) {
    if (options_.takes_time) pose = head(t_s + step_s * beam);
    const LidarBeam ray = beam_of(pose, scan.angle_step_rad * beam, options_.height_m);
    scan.ranges_m.push_back(read(echo_m(cast(below_ceiling, ray, options_.range_max_m))));
  }
  return scan;
}

/// The distance that comes back, without noise; 0 where something is met that gives no echo.
double SimulatedLidar::echo_m(const Echoes& echoes) {
  double range_m = echoes.swallowed ? 0.0 : echoes.end_m;
  if (echoes.panes > 0) {
    const bool mirrors = echoes.pane_cosine >= kMirrorCosine;
    bool passes = true;
    for (int pane = 0; pane < echoes.panes; ++pane) passes = glass_.chance(kPassesShare) && passes;
    if (mirrors) range_m = echoes.pane_m;
    if (!mirrors && !passes) range_m = 0.0;
  }
  return options_.smoke_sight_m > 0.0 ? through_smoke_m(range_m) : range_m;
}

double SimulatedLidar::through_smoke_m(double range_m) {
  const double luck = smoke_.uniform(), depth = smoke_.uniform();
  const double comes_back = range_m > 0.0 ? std::exp(-range_m / options_.smoke_sight_m) : 0.0;
  if (luck < comes_back) return range_m;
  if (luck >= comes_back + kSmokeShare * (1.0 - comes_back)) return 0.0;
  const double smoke_m =
      options_.range_min_m - kSmokeDepth * options_.smoke_sight_m * std::log1p(-depth);
  return range_m > 0.0 ? std::min(smoke_m, range_m) : smoke_m;
}

float SimulatedLidar::read(double true_range_m) {
  // Drawn for every beam, hit or not, so that one beam's fate does not shift the others' noise.
  const double noise = noise_.next();
  const bool dropped = luck_.uniform() < options_.dropout_share;
  if (dropped || true_range_m == 0.0) return 0.0F;
  if (!std::isfinite(true_range_m)) return std::numeric_limits<float>::infinity();
  const double sigma_m = options_.noise_m * (1.0 + 0.1 * true_range_m);
  const double range_m = true_range_m + sigma_m * noise;
  const double rounded_m = std::round(range_m / options_.resolution_m) * options_.resolution_m;
  if (rounded_m < options_.range_min_m) return 0.0F;
  if (rounded_m > options_.range_max_m) return std::numeric_limits<float>::infinity();
  return static_cast<float>(rounded_m);
}

SimulatedAhrs::SimulatedAhrs(std::uint64_t seed)
    : noise_(seed),
      tilt_noise_(stir(seed, 1)),
      zero_rad_(Draw(stir(seed, 0)).between(-std::numbers::pi, std::numbers::pi)) {}

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
