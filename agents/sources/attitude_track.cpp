#include "agents/sources/attitude_track.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace lifeline::sources {
namespace {

/// A recording's messages as a source.
class RecordedAttitudes final : public sensing::AttitudeSource {
 public:
  explicit RecordedAttitudes(ImuStream samples) : samples_(std::move(samples)) {}

  Result<sensing::AttitudeRead> next(SteadyTime /*deadline*/) override {
    for (;;) {
      const auto sample = samples_();
      if (!sample) return forward_error(sample);
      if (!*sample) return sensing::AttitudeRead{{}, true};
      if (!(*sample)->R_world_body) continue;
      return sensing::AttitudeRead{{{(*sample)->stamp, *(*sample)->R_world_body}}, false};
    }
  }

 private:
  ImuStream samples_;
};

}  // namespace

sensing::Attitude to_attitude(const Eigen::Quaterniond& R_world_body) {
  const Eigen::Matrix3d R = R_world_body.toRotationMatrix();
  return {.roll_rad = std::atan2(R(2, 1), R(2, 2)),
          .pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          .yaw_rad = std::atan2(R(1, 0), R(0, 0))};
}

AttitudeTrack::AttitudeTrack(ImuStream samples)
    : source_(std::make_unique<RecordedAttitudes>(std::move(samples))) {}

/// The sample behind all that were read; empty at the end, and where none came in time.
Result<std::optional<AttitudeTrack::Sample>> AttitudeTrack::read(SteadyTime deadline) {
  if (ended_) return std::nullopt;
  auto next = source_->next(deadline);
  if (!next) return forward_error(next);
  ended_ = next->ended;
  return next->sample;
}

Result<std::optional<sensing::Attitude>> AttitudeTrack::at(Timestamp stamp, SteadyTime deadline) {
  while (!after_ || after_->stamp < stamp) {
    std::optional<Sample> next;
    if (ahead_.empty()) {
      const auto came = read(deadline);
      if (!came) return forward_error(came);
      next = *came;
    } else {
      next = ahead_.front();
      ahead_.pop_front();
    }
    if (!next && !ended_) break;  // it may still come
    if (!next && !after_) break;
    before_ = std::exchange(after_, next);
    if (!next) break;
  }
  const auto near = [stamp](const std::optional<Sample>& held) {
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

Result<void> AttitudeTrack::read_ahead(Timestamp stamp, SteadyTime deadline) {
  while (is_behind(stamp) && ahead_.size() < kMostAhead) {
    const auto next = read(deadline);
    if (!next) return forward_error(next);
    if (!*next) return {};
    ahead_.push_back(**next);
  }
  return {};
}

Result<void> AttitudeTrack::follow_set_back(Timestamp stamp) {
  if (!after_ || after_->stamp - stamp <= kReach) return {};
  if (before_ && before_->stamp <= stamp) return {};
  for (;;) {
    const auto next = read(std::chrono::steady_clock::now());
    if (!next) return forward_error(next);
    if (!*next) return {};
    const Sample& newest = ahead_.empty() ? *after_ : ahead_.back();
    if (newest.stamp - (*next)->stamp > kReach) {
      before_.reset();
      after_ = *next;
      ahead_.clear();
      if (after_->stamp - stamp <= kReach) return {};
    } else {
      if (ahead_.size() == kMostAhead) ahead_.pop_front();
      ahead_.push_back(**next);
    }
  }
}

bool AttitudeTrack::is_behind(Timestamp stamp) const {
  if (!ahead_.empty()) return ahead_.back().stamp < stamp;
  return !after_ || after_->stamp < stamp;
}

Result<void> AttitudeTrack::fill(sensing::RawScan& scan, SteadyTime deadline) {
  const auto attitude = at(scan.stamp, deadline);
  if (!attitude) return forward_error(attitude);
  scan.attitude = *attitude;
  scan.later_attitudes.clear();
  if (!scan.attitude || scan.sweep_time <= Duration{0}) return {};
  const Timestamp end = scan.stamp + scan.sweep_time;
  if (auto ahead = read_ahead(end, deadline); !ahead) return ahead;
  Timestamp last = scan.stamp;
  const auto add = [&](const Sample& sample) {
    if (sample.stamp <= last || last >= end) return true;
    if (sample.stamp - last > kReach) return false;
    last = sample.stamp;
    scan.later_attitudes.push_back({last - scan.stamp, to_attitude(sample.R_world_body)});
    return true;
  };
  bool unbroken = !after_ || add(*after_);
  for (const Sample& sample : ahead_) unbroken = unbroken && add(sample);
  if (!unbroken) scan.later_attitudes.clear();
  return {};
}

}  // namespace lifeline::sources
