#include "agents/slam/motion_model.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lifeline::slam {
namespace {

/// Share of the newest interval in the usual one.
constexpr double kIntervalShare = 0.1;
/// The same where the scans stopped for a while: that alone makes no keyframes of them.
constexpr double kGapShare = 0.02;
/// Scans that usually come this fast come from a lidar at work.
constexpr double kLiveInterval_s = 0.2;
/// Of a wearer of whose motion nothing is known.
constexpr double kFirstSpeed_m_s = 1.0;

bool is_live(Duration elapsed) {
  return elapsed > Duration{0} && to_seconds(elapsed) <= kLongestStep_s;
}

}  // namespace

double half_sweep_s(const MotionPrior& prior) {
  return 0.5 * std::clamp(to_seconds(prior.sweep), 0.0, std::max(0.0, to_seconds(prior.elapsed)));
}

bool MotionModel::is_walk(const MotionPrior& prior) const {
  return walk_ && !prior.T_previous_now && is_live(prior.elapsed);
}

WalkState MotionModel::ahead(const MotionPrior& prior) const {
  const double dt_s = to_seconds(prior.elapsed);
  // Scans that come in a burst were not taken in one: their stamps are not to be relied on.
  return WalkFilter(config_.walk_acceleration_m_s2)
      .after(*walk_, dt_s, std::max(dt_s, interval_s_));
}

Pose2 MotionModel::predicted_step(const MotionPrior& prior) const {
  Pose2 step = prior.T_previous_now.value_or(last_step_);
  if (is_walk(prior)) {
    const Eigen::Vector2d to = ahead(prior).position_m();
    step = T_map_head_.inverse() * Pose2{to.x(), to.y(), T_map_head_.yaw_rad};
    step.yaw_rad = 0.0;
    if (is_live(last_elapsed_)) {
      const double longer = to_seconds(prior.elapsed) / to_seconds(last_elapsed_);
      step.yaw_rad = normalise_angle(longer * last_step_.yaw_rad);
    }
  }
  if (prior.yaw_step_rad) step.yaw_rad = *prior.yaw_step_rad;
  return step;
}

Prediction MotionModel::predict(const MotionPrior& prior) const {
  const Pose2 step = predicted_step(prior);
  const double length_m = step.translation().norm(), turn_rad = std::abs(step.yaw_rad);
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
  Prediction prediction{T_map_head_ * step, std::min(sigma_xy_m_ + xy_m, config_.lost_max_xy_m),
                        std::min(sigma_yaw_rad_ + yaw_rad, config_.lost_max_yaw_rad)};
  if (is_walk(prior)) {
    prediction.sigma_xy_m = config_.walk_floor_xy_m;
    prediction.left_open = ahead(prior).position_covariance(half_sweep_s(prior));
  }
  return prediction;
}

void MotionModel::reset(const Pose2& T_map_head) {
  T_map_head_ = T_map_head;
  last_step_ = {};
  last_elapsed_ = {};
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
  walk_ = WalkFilter::begin(T_map_head.translation(), 0.0, kFirstSpeed_m_s);
}

void MotionModel::move(const Pose2& T_new_old) {
  T_map_head_ = T_new_old * T_map_head_;
  if (!walk_) return;
  Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_new_old.yaw_rad).toRotationMatrix();
  turn.bottomRightCorner<2, 2>() = turn.topLeftCorner<2, 2>();
  walk_->mean = turn * walk_->mean;
  walk_->mean.head<2>() += T_new_old.translation();
  walk_->covariance = turn * walk_->covariance * turn.transpose();
}

void MotionModel::matched(const Pose2& T_map_head, const MotionPrior& prior,
                          const PositionFix& fix) {
  const Eigen::Vector2d p_map_m = T_map_head.translation();
  std::optional<WalkState> next;
  if (is_walk(prior)) next = ahead(prior);
  if (!next || WalkFilter::sigmas_off(*next, p_map_m, fix) > config_.walk_max_sigmas)
    next = WalkFilter::begin(p_map_m, 1.0, kFirstSpeed_m_s);
  walk_ = WalkFilter::take_in(*next, p_map_m, fix);
  last_step_ = T_map_head_.inverse() * T_map_head;
  last_elapsed_ = prior.elapsed;
  note_interval(prior.elapsed);
  T_map_head_ = T_map_head;
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
}

void MotionModel::found(const Pose2& T_map_head, const Eigen::Matrix2d& covariance_xy) {
  T_map_head_ = T_map_head;
  sigma_xy_m_ = sigma_yaw_rad_ = 0.0;
  if (!walk_) return;
  walk_->mean.head<2>() = T_map_head.translation();
  set_place_doubt(covariance_xy);
}

void MotionModel::doubt(double sigma_xy_m, double sigma_yaw_rad) {
  sigma_xy_m_ = sigma_xy_m;
  sigma_yaw_rad_ = sigma_yaw_rad;
  set_place_doubt(sigma_xy_m * sigma_xy_m * Eigen::Matrix2d::Identity());
}

// The velocity stays as sure as it was, and tells nothing of what is wrong with the place.
void MotionModel::set_place_doubt(const Eigen::Matrix2d& covariance_xy) {
  if (!walk_) return;
  walk_->covariance.topRows<2>().setZero();
  walk_->covariance.leftCols<2>().setZero();
  walk_->covariance.topLeftCorner<2, 2>() = covariance_xy;
}

void MotionModel::lost(const Prediction& prediction, const MotionPrior& prior) {
  if (is_walk(prior)) {
    walk_ = ahead(prior);
  } else {
    walk_.reset();
  }
  note_interval(prior.elapsed);
  T_map_head_ = prediction.T_map_head;
  sigma_xy_m_ = prediction.largest_sigma_m();
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
