#include "agents/slam/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::slam {
namespace {

/// Share of the newest interval in the usual one.
constexpr double kIntervalShare = 0.1;
/// The same where the scans stopped for a while: that alone makes no keyframes of them.
constexpr double kGapShare = 0.02;
/// Scans that usually come this fast come from a lidar at work.
constexpr double kLiveInterval_s = 0.2;

bool is_live(Duration elapsed) {
  return elapsed > Duration{0} && to_seconds(elapsed) <= kLongestStep_s;
}

}  // namespace

Pose2 MotionModel::predicted_step(const MotionPrior& prior) const {
  if (prior.T_previous_now) {
    Pose2 step = *prior.T_previous_now;
    if (prior.yaw_step_rad) step.yaw_rad = *prior.yaw_step_rad;
    return step;
  }
  Pose2 step = last_step_;
  if (is_live(prior.elapsed) && is_live(last_elapsed_)) {
    const double longer = to_seconds(prior.elapsed) / to_seconds(last_elapsed_);
    step = {longer * step.x_m, longer * step.y_m, normalise_angle(longer * step.yaw_rad)};
  }
  if (prior.yaw_step_rad) step.yaw_rad = *prior.yaw_step_rad;
  return step;
}

Prediction MotionModel::predict(const MotionPrior& prior) const {
  const Pose2 step = predicted_step(prior);
  const double length_m = step.translation().norm(), turn_rad = std::abs(step.yaw_rad);
  // Scans that come in a burst were not taken in one: their stamps are not to be relied on.
  const double dt_s = std::max(to_seconds(prior.elapsed), interval_s_);
  // Without a usable clock the step may have been any.
  const bool timed = prior.elapsed > Duration{0};
  double xy_m = config_.max_xy_m, yaw_rad = config_.max_yaw_rad;
  if (prior.T_previous_now) {
    xy_m = config_.odometry_xy_m + config_.odometry_share * (length_m + 0.3 * turn_rad);
    yaw_rad = config_.odometry_yaw_rad + config_.odometry_share * (turn_rad + 0.3 * length_m);
  } else if (timed) {
    xy_m = std::min(xy_m, config_.floor_xy_m + 0.5 * config_.acceleration_m_s2 * dt_s * dt_s);
    yaw_rad = std::min(yaw_rad,
                       config_.floor_yaw_rad + 0.5 * config_.yaw_acceleration_rad_s2 * dt_s * dt_s);
  }
  if (prior.yaw_step_rad) yaw_rad = config_.attitude_yaw_rad;
  return {T_map_head_ * step, std::min(sigma_xy_m_ + xy_m, config_.lost_max_xy_m),
          std::min(sigma_yaw_rad_ + yaw_rad, config_.lost_max_yaw_rad)};
}

void MotionModel::reset(const Pose2& T_map_head) {
  T_map_head_ = T_map_head;
  last_step_ = {};
  last_elapsed_ = {};
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
}

void MotionModel::matched(const Pose2& T_map_head, const MotionPrior& prior) {
  last_step_ = T_map_head_.inverse() * T_map_head;
  last_elapsed_ = prior.elapsed;
  note_interval(prior.elapsed);
  T_map_head_ = T_map_head;
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
}

void MotionModel::found(const Pose2& T_map_head) {
  T_map_head_ = T_map_head;
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
}

void MotionModel::lost(const Prediction& prediction, const MotionPrior& prior) {
  note_interval(prior.elapsed);
  T_map_head_ = prediction.T_map_head;
  sigma_xy_m_ = prediction.sigma_xy_m;
  sigma_yaw_rad_ = prediction.sigma_yaw_rad;
}

bool MotionModel::is_lidar_at_work() const {
  return interval_s_ > 0.0 && interval_s_ <= kLiveInterval_s;
}

bool MotionModel::is_gap(Duration elapsed) const {
  return is_lidar_at_work() && to_seconds(elapsed) > kLongestStep_s;
}

void MotionModel::note_interval(Duration elapsed) {
  if (elapsed <= Duration{0}) return;
  const double seconds = std::min(to_seconds(elapsed), kLongestStep_s);
  const double share = is_gap(elapsed) ? kGapShare : kIntervalShare;
  interval_s_ = interval_s_ == 0.0 ? seconds : interval_s_ + share * (seconds - interval_s_);
}

}  // namespace lifeline::slam
