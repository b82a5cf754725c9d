#include "agents/sensing/sweep_attitude.hpp"

#include <algorithm>
#include <cmath>

#include "agents/sensing/rotation.hpp"

namespace lifeline::sensing {

SweepAttitude::SweepAttitude(const RawScan& raw, double max_tilt_rad)
    : raw_(raw),
      max_tilt_rad_(max_tilt_rad),
      constant_(!raw.attitude || raw.later_attitudes.empty() || raw.sweep_time <= Duration{0}),
      knows_yaw_(raw.attitude && std::isfinite(raw.attitude->yaw_rad)) {
  if (constant_) return;
  before_ = after_ = knot(0);
}

/// Knot 0 is the attitude at the stamp.
SweepAttitude::Knot SweepAttitude::knot(std::size_t index) const {
  const TimedAttitude timed =
      index == 0 ? TimedAttitude{{}, *raw_.attitude} : raw_.later_attitudes[index - 1];
  const Attitude& attitude = timed.attitude;
  const double turn_rad = knows_yaw_ ? attitude.yaw_rad - raw_.attitude->yaw_rad : 0.0;
  // Not finite fails every comparison.
  if (!(std::abs(attitude.pitch_rad) <= max_tilt_rad_) ||
      !(std::abs(attitude.roll_rad) <= max_tilt_rad_) || !std::isfinite(turn_rad)) {
    return {timed.after_stamp, std::nullopt};
  }
  return {timed.after_stamp, rotation_zyx(attitude.roll_rad, attitude.pitch_rad, turn_rad)};
}

std::optional<Eigen::Matrix3d> SweepAttitude::at(Duration after_stamp) {
  if (constant_) {
    if (!raw_.attitude) return Eigen::Matrix3d::Identity();
    return rotation_zyx(raw_.attitude->roll_rad, raw_.attitude->pitch_rad, 0.0).toRotationMatrix();
  }
  while (after_.after_stamp < after_stamp && next_ < raw_.later_attitudes.size()) {
    before_ = after_;
    after_ = knot(++next_);
  }
  if (!after_.R_head_body) return std::nullopt;
  if (after_stamp >= after_.after_stamp) return after_.R_head_body->toRotationMatrix();
  if (!before_.R_head_body) return std::nullopt;
  // Samples may share a time, or be out of order: then the later one counts.
  const double between_s = to_seconds(after_.after_stamp - before_.after_stamp);
  if (!(between_s > 0.0)) return after_.R_head_body->toRotationMatrix();
  const double share =
      std::clamp(to_seconds(after_stamp - before_.after_stamp) / between_s, 0.0, 1.0);
  // Between samples of one sweep a head turns by a few degrees: the normalised mean of two
  // rotations so close is as good as the one on the sphere, and needs no sine.
  Eigen::Vector4d to = after_.R_head_body->coeffs();
  if (to.dot(before_.R_head_body->coeffs()) < 0.0) to = -to;
  const Eigen::Vector4d mean = (1.0 - share) * before_.R_head_body->coeffs() + share * to;
  return Eigen::Quaterniond(mean).normalized().toRotationMatrix();
}

}  // namespace lifeline::sensing
