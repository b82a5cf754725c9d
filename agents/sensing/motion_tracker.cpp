#include "agents/sensing/motion_tracker.hpp"

#include <cmath>

namespace lifeline::sensing {

SensedMotion MotionTracker::next(const RawScan& raw) {
  std::optional<Pose2> T_odom_head = raw.T_odom_head;
  if (T_odom_head && !T_odom_head->is_finite()) T_odom_head.reset();
  std::optional<double> yaw_rad;
  if (raw.attitude && std::isfinite(raw.attitude->yaw_rad)) yaw_rad = raw.attitude->yaw_rad;

  SensedMotion motion;
  motion.sweep = raw.sweep_time;
  if (started_) {
    motion.elapsed = raw.stamp - stamp_;
    if (T_odom_head && T_odom_head_) {
      motion.T_previous_now = T_odom_head_->inverse() * *T_odom_head;
    }
    if (yaw_rad && yaw_rad_) motion.yaw_step_rad = normalise_angle(*yaw_rad - *yaw_rad_);
  }
  started_ = true;
  stamp_ = raw.stamp;
  T_odom_head_ = T_odom_head;
  yaw_rad_ = yaw_rad;
  return motion;
}

}  // namespace lifeline::sensing
