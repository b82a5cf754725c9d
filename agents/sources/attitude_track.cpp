#include "agents/sources/attitude_track.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace lifeline::sources {

sensing::Attitude to_attitude(const Eigen::Quaterniond& R_world_body) {
  const Eigen::Matrix3d R = R_world_body.toRotationMatrix();
  return {.roll_rad = std::atan2(R(2, 1), R(2, 2)),
          .pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          .yaw_rad = std::atan2(R(1, 0), R(0, 0))};
}

/// The next sample that has an orientation.
Result<std::optional<AttitudeTrack::Held>> AttitudeTrack::next_held() {
  for (;;) {
    const auto sample = samples_();
    if (!sample) return forward_error(sample);
    if (!*sample) return std::nullopt;
    if ((*sample)->R_world_body) return Held{(*sample)->stamp, *(*sample)->R_world_body};
  }
}

Result<std::optional<sensing::Attitude>> AttitudeTrack::at(Timestamp stamp) {
  while (!ended_ && (!after_ || after_->stamp < stamp)) {
    const auto next = next_held();
    if (!next) return forward_error(next);
    ended_ = !*next;
    before_ = after_;
    after_ = *next;
  }
  const auto near = [stamp](const std::optional<Held>& held) {
    return held && std::chrono::abs(held->stamp - stamp) <= kReach;
  };
  const bool near_before = near(before_), near_after = near(after_);
  if (near_before && near_after && before_->stamp < after_->stamp) {
    const double share = std::clamp(
        to_seconds(stamp - before_->stamp) / to_seconds(after_->stamp - before_->stamp), 0.0, 1.0);
    return to_attitude(before_->R_world_body.slerp(share, after_->R_world_body));
  }
  if (near_after) return to_attitude(after_->R_world_body);
  if (near_before) return to_attitude(before_->R_world_body);
  return std::nullopt;
}

}  // namespace lifeline::sources
