#include "agents/sensing/head_projection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "agents/sensing/rotation.hpp"
#include "agents/sensing/sweep_attitude.hpp"

namespace lifeline::sensing {
namespace {

/// A sensor may state any number of beams; more than a sweep of 0.02 deg is a mistake.
constexpr std::size_t kMaxBeams = 18000;

BeamKind classify(double range_m, const RawScan& raw, const ProjectionConfig& config) {
  if (!std::isfinite(range_m) || range_m <= 0.0 || range_m < raw.range_min_m) {
    return BeamKind::invalid;
  }
  return range_m < std::min(raw.range_max_m, config.max_range_m) ? BeamKind::hit
                                                                 : BeamKind::no_return;
}

/// Where a beam begins and points, in the head frame.
struct Ray {
  Eigen::Vector3d from_m;  ///< against where the lidar is when the head is level
  Eigen::Vector3d along;   ///< of length 1
  bool known = true;       ///< else held too steeply: about where it points
};

/// The lidar as the head holds it in the course of a sweep.
class HeldLidar {
 public:
  HeldLidar(const RawScan& raw, const ProjectionConfig& config)
      : attitude_(raw, config.max_tilt_rad),
        R_body_laser_(
            rotation_zyx(config.mount.roll_rad, config.mount.pitch_rad, config.mount.yaw_rad)
                .toRotationMatrix()),
        lever_body_m_(config.mount.lever_body_m) {
    hold(Duration{0});
  }

  /// Whether rays stand in the heading of the stamp, however the head turned within the sweep.
  [[nodiscard]] bool turn_undone() const { return attitude_.knows_turn(); }

  /// The ray of the beam that points `along` in the laser frame. Ask in the order of time.
  [[nodiscard]] Ray ray(const Eigen::Vector2d& along, Duration after_stamp) {
    if (!attitude_.is_constant()) hold(after_stamp);
    return {moved_m_, R_head_laser_.leftCols<2>() * along, known_};
  }

 private:
  void hold(Duration after_stamp) {
    const auto R_head_body = attitude_.at(after_stamp);
    known_ = R_head_body.has_value();
    if (!known_) return;
    R_head_laser_ = *R_head_body * R_body_laser_;
    moved_m_ = *R_head_body * lever_body_m_ - lever_body_m_;
  }

  SweepAttitude attitude_;
  Eigen::Matrix3d R_body_laser_;
  Eigen::Vector3d lever_body_m_;
  bool known_ = false;
  Eigen::Matrix3d R_head_laser_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d moved_m_ = Eigen::Vector3d::Zero();
};

/// Whether the reading ends at a wall: neither at the floor nor at the ceiling.
bool ends_between_floor_and_ceiling(double range_m, const Ray& ray,
                                    const ProjectionConfig& config) {
  // A level beam is never cut, whatever the heights say.
  if (ray.along.z() == 0.0) return true;
  const double end_height_m = config.sensor_height_m + ray.from_m.z() + range_m * ray.along.z();
  const double margin_m = config.height_margin_m + range_m * config.tilt_margin_rad;
  return end_height_m > margin_m && end_height_m < config.ceiling_height_m - margin_m;
}

Beam2 project(const Ray& ray, double range_m, const RawScan& raw, const ProjectionConfig& config) {
  Beam2 beam;
  beam.angle_rad = std::atan2(static_cast<float>(ray.along.y()), static_cast<float>(ray.along.x()));
  beam.kind = classify(range_m, raw, config);
  if (beam.kind != BeamKind::hit) return beam;
  if (!ray.known || !ends_between_floor_and_ceiling(range_m, ray, config)) {
    beam.kind = BeamKind::invalid;
    return beam;
  }
  const double x_m = ray.from_m.x() + range_m * ray.along.x();
  const double y_m = ray.from_m.y() + range_m * ray.along.y();
  beam.x_m = static_cast<float>(x_m);
  beam.y_m = static_cast<float>(y_m);
  if (ray.from_m.head<2>().isZero(0.0)) {
    beam.range_m = static_cast<float>(range_m * std::hypot(ray.along.x(), ray.along.y()));
  } else {
    // Seen from the head's origin, which is not quite where the beam began.
    beam.range_m = static_cast<float>(std::hypot(x_m, y_m));
    beam.angle_rad = static_cast<float>(std::atan2(y_m, x_m));
  }
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
  if (!is_usable(raw, config) || raw.ranges_m.empty()) return scan;
  HeldLidar lidar(raw, config);
  scan.turn_undone = lidar.turn_undone();
  scan.beams.reserve(raw.ranges_m.size());
  const double step_s =
      to_seconds(scan.sweep_time) / std::max(static_cast<double>(raw.ranges_m.size()) - 1.0, 1.0);
  // Each beam's direction is its predecessor's turned by one step: no sine or cosine per beam.
  const double c = std::cos(raw.angle_step_rad), s = std::sin(raw.angle_step_rad);
  Eigen::Vector2d along(std::cos(raw.first_angle_rad), std::sin(raw.first_angle_rad));
  for (const float range_m : raw.ranges_m) {
    const Duration after_stamp = from_seconds(step_s * static_cast<double>(scan.beams.size()));
    const Ray ray = lidar.ray(along, after_stamp);
    scan.beams.push_back(project(ray, static_cast<double>(range_m), raw, config));
    along = {c * along.x() - s * along.y(), s * along.x() + c * along.y()};
  }
  const double swept_rad = std::abs(raw.angle_step_rad) * static_cast<double>(scan.beams.size());
  scan.full_circle = swept_rad > 2.0 * std::numbers::pi - 0.75 * std::abs(raw.angle_step_rad);
  return scan;
}

}  // namespace lifeline::sensing
