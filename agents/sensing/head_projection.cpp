#include "agents/sensing/head_projection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lifeline::sensing {
namespace {

/// A sensor may state any number of beams; more than a sweep of 0.02 deg is a mistake.
constexpr std::size_t kMaxBeams = 18000;

/// R_head_laser, yaw left out: nose down by pitch after leaning by roll.
Eigen::Matrix3d tilt(const std::optional<Attitude>& attitude) {
  if (!attitude) return Eigen::Matrix3d::Identity();
  return (Eigen::AngleAxisd(attitude->pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(attitude->roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

BeamKind classify(double range_m, const RawScan& raw, const ProjectionConfig& config) {
  if (!std::isfinite(range_m) || range_m <= 0.0 || range_m < raw.range_min_m) {
    return BeamKind::invalid;
  }
  return range_m < std::min(raw.range_max_m, config.max_range_m) ? BeamKind::hit
                                                                 : BeamKind::no_return;
}

/// Whether the reading ends at a wall: neither at the floor nor at the ceiling.
bool ends_between_floor_and_ceiling(double range_m, double rise, const ProjectionConfig& config) {
  const double end_height_m = config.sensor_height_m + range_m * rise;
  // A level beam is never cut, whatever the heights say.
  if (rise == 0.0) return true;
  return end_height_m > config.height_margin_m &&
         end_height_m < config.ceiling_height_m - config.height_margin_m;
}

/// `along` is the beam's direction in the head frame, in space.
Beam2 project(const Eigen::Vector3d& along, double range_m, const RawScan& raw,
              const ProjectionConfig& config) {
  Beam2 beam;
  beam.angle_rad = std::atan2(static_cast<float>(along.y()), static_cast<float>(along.x()));
  beam.kind = classify(range_m, raw, config);
  if (beam.kind != BeamKind::hit) return beam;
  if (!ends_between_floor_and_ceiling(range_m, along.z(), config)) {
    beam.kind = BeamKind::invalid;
    return beam;
  }
  beam.range_m = static_cast<float>(range_m * std::hypot(along.x(), along.y()));
  beam.x_m = static_cast<float>(range_m * along.x());
  beam.y_m = static_cast<float>(range_m * along.y());
  return beam;
}

bool is_usable(const RawScan& raw, const ProjectionConfig& config) {
  if (!std::isfinite(raw.first_angle_rad) || !std::isfinite(raw.angle_step_rad) ||
      std::abs(raw.first_angle_rad) > 100.0 || raw.angle_step_rad == 0.0 ||
      std::abs(raw.angle_step_rad) > std::numbers::pi || raw.ranges_m.size() > kMaxBeams) {
    return false;
  }
  if (!raw.attitude) return true;
  // Not finite fails both comparisons.
  return std::abs(raw.attitude->pitch_rad) <= config.max_tilt_rad &&
         std::abs(raw.attitude->roll_rad) <= config.max_tilt_rad;
}

}  // namespace

Scan2 project_scan(const RawScan& raw, const ProjectionConfig& config) {
  Scan2 scan;
  scan.stamp = raw.stamp;
  scan.sweep_time = std::max(raw.sweep_time, Duration{0});
  if (!is_usable(raw, config)) return scan;
  const Eigen::Matrix3d R_head_laser = tilt(raw.attitude);
  scan.beams.reserve(raw.ranges_m.size());
  // Each beam's direction is its predecessor's turned by one step: no sine or cosine per beam.
  const double c = std::cos(raw.angle_step_rad), s = std::sin(raw.angle_step_rad);
  Eigen::Vector2d along(std::cos(raw.first_angle_rad), std::sin(raw.first_angle_rad));
  for (const float range_m : raw.ranges_m) {
    scan.beams.push_back(
        project(R_head_laser.leftCols<2>() * along, static_cast<double>(range_m), raw, config));
    along = {c * along.x() - s * along.y(), s * along.x() + c * along.y()};
  }
  const double swept_rad = std::abs(raw.angle_step_rad) * static_cast<double>(scan.beams.size());
  scan.full_circle = swept_rad > 2.0 * std::numbers::pi - 0.75 * std::abs(raw.angle_step_rad);
  return scan;
}

}  // namespace lifeline::sensing
