#include "agents/slam/keyframe_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/covariance.hpp"

namespace lifeline::slam {
namespace {

/// However short the step.
constexpr double kRounding_m = 0.002;
constexpr double kRounding_rad = 0.0003;

}  // namespace

void KeyframeLog::note_lost(const Prediction& prediction) {
  lost_covariance_ += diagonal_covariance(prediction.largest_sigma_m(), prediction.sigma_yaw_rad);
}

bool KeyframeLog::is_due(const Pose2& T_map_head) const {
  if (poses_.empty()) return true;
  const Pose2 moved = poses_.back().inverse() * T_map_head;
  return moved.translation().norm() >= config_.distance_m ||
         std::abs(moved.yaw_rad) >= config_.turn_rad;
}

void KeyframeLog::keep(Timestamp stamp, const Pose2& T_map_head, const Eigen::Matrix3d& covariance,
                       std::span<const SurfacePiece> pieces) {
  if (config_.hand_over) {
    Keyframe keyframe = made(stamp, T_map_head, covariance);
    keyframe.surface = PackedSurface(pieces);
    waiting_.push_back(keyframe);
    if (recent_.size() == kRecent) recent_.erase(recent_.begin());
    recent_.push_back(std::move(keyframe));
  }
  poses_.push_back(T_map_head);
  lost_covariance_.setZero();
}

Keyframe KeyframeLog::made(Timestamp stamp, const Pose2& T_map_head,
                           const Eigen::Matrix3d& covariance) const {
  Keyframe keyframe;
  const Pose2 T_map_previous = poses_.empty() ? Pose2{} : poses_.back();
  keyframe.index = static_cast<KeyframeIndex>(poses_.size());
  keyframe.stamp = stamp;
  keyframe.T_map_head = T_map_head;
  keyframe.T_previous_this = T_map_previous.inverse() * T_map_head;
  keyframe.step_covariance = turn_covariance(covariance + lost_covariance_, T_map_previous.yaw_rad);
  // What no match knows of: the map's own error between two places.
  keyframe.step_covariance += keyframe.T_previous_this.translation().norm() *
                              diagonal_covariance(config_.noise_xy_m, config_.noise_yaw_rad);
  keyframe.step_covariance += diagonal_covariance(kRounding_m, kRounding_rad);
  return keyframe;
}

std::vector<Keyframe> KeyframeLog::take() {
  return std::exchange(waiting_, {});
}

std::optional<Pose2> KeyframeLog::rebase(const MapCorrection& correction) {
  const std::size_t known = correction.T_map_head.size();
  if (!can_rebase(known)) return std::nullopt;
  const Pose2 T_new_old = correction.T_map_head.back() * poses_[known - 1].inverse();
  std::copy(correction.T_map_head.begin(), correction.T_map_head.end(), poses_.begin());
  for (std::size_t i = known; i < poses_.size(); ++i) poses_[i] = T_new_old * poses_[i];
  for (Keyframe& keyframe : recent_) keyframe.T_map_head = poses_[keyframe.index];
  return T_new_old;
}

std::span<const Keyframe> KeyframeLog::unknown_to(const MapCorrection& correction) const {
  return std::span(recent_).last(poses_.size() - correction.T_map_head.size());
}

}  // namespace lifeline::slam
