#include "agents/slam/deskew.hpp"

#include <cmath>

namespace lifeline::slam {
namespace {

/// Faster than any head: such a motion is a mistake upstream.
constexpr double kFastest_m_s = 10.0;
constexpr double kFastest_rad_s = 15.0;

}  // namespace

void deskew(Scan2& scan, const Pose2& motion, Duration over) {
  if (scan.sweep_time <= Duration{0} || over <= Duration{0} || scan.beams.size() < 2) return;
  const double over_s = to_seconds(over);
  const double vx = motion.x_m / over_s, vy = motion.y_m / over_s;
  const double turn_rad_s = scan.turn_undone ? 0.0 : motion.yaw_rad / over_s;
  if (!(std::hypot(vx, vy) < kFastest_m_s) || !(std::abs(turn_rad_s) < kFastest_rad_s)) return;
  const double step_s = to_seconds(scan.sweep_time) / static_cast<double>(scan.beams.size() - 1);
  // The turn from beam to beam is always the same: no sine or cosine per beam.
  const double c1 = std::cos(turn_rad_s * step_s), s1 = std::sin(turn_rad_s * step_s);
  double c = 1.0, s = 0.0, t_s = 0.0;
  for (Beam2& beam : scan.beams) {
    if (beam.kind == BeamKind::hit) {
      const double x = c * beam.x_m - s * beam.y_m + vx * t_s;
      const double y = s * beam.x_m + c * beam.y_m + vy * t_s;
      beam.x_m = static_cast<float>(x);
      beam.y_m = static_cast<float>(y);
      beam.range_m = static_cast<float>(std::hypot(x, y));
      beam.angle_rad = static_cast<float>(std::atan2(y, x));
    } else {
      beam.angle_rad = static_cast<float>(
          normalise_angle(static_cast<double>(beam.angle_rad) + turn_rad_s * t_s));
    }
    const double turned = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = turned;
    t_s += step_s;
  }
}

}  // namespace lifeline::slam
