#include "agents/ahrs/attitude_watch.hpp"

#include <algorithm>

namespace lifeline::ahrs {
namespace {

constexpr int kFrozenRepeats = 5;
constexpr Duration kShortestGap = std::chrono::milliseconds(100);
/// A head turns by 10 rad/s at most; the rest is for times that are not quite right.
constexpr double kFastestRadS = 20.0;
constexpr double kLeapRad = 0.1;
/// So many leaps in a row, and the sensor has made up its mind.
constexpr int kMostLeaps = 3;

bool is_recent(const std::optional<SteadyTime>& when, SteadyTime now) {
  return when && now - *when < AttitudeWatch::kRemembered;
}

}  // namespace

void AttitudeWatch::start(SteadyTime now) {
  started_ = now;
  last_.reset();
  bytes_at_.reset();
  repeats_ = leaps_in_a_row_ = 0;
  rates_.reset();
}

bool AttitudeWatch::take(const AhrsReading& reading, SteadyTime stamp, SteadyTime received) {
  ++counts_.readings;
  if (last_) {
    const double since_s = to_seconds(received - last_->received);
    if (received - last_->received > kShortestGap && since_s > 3.0 * interval_s_) {
      ++counts_.gaps;
      gap_at_ = received;
    } else {
      interval_s_ += interval_s_ == 0.0 ? since_s : 0.05 * (since_s - interval_s_);
    }
    if (leaps(reading, stamp, received)) return false;
  }
  const bool repeated = last_ && reading.content == last_->reading.content;
  repeats_ = repeated ? repeats_ + 1 : 0;
  if (!repeated) changed_ = received;
  last_ = {reading, stamp, received};
  if (repeats_ >= kFrozenRepeats && received - changed_ >= kFrozenAfter) return false;
  rates_.add(reading, stamp);
  return true;
}

bool AttitudeWatch::leaps(const AhrsReading& reading, SteadyTime stamp, SteadyTime received) {
  const double turned_rad = last_->reading.R_world_body.angularDistance(reading.R_world_body);
  const double most_rad = kLeapRad + kFastestRadS * std::max(to_seconds(stamp - last_->stamp), 0.0);
  if (turned_rad <= most_rad || ++leaps_in_a_row_ > kMostLeaps) {
    leaps_in_a_row_ = 0;
    return false;
  }
  ++counts_.leaps;
  leapt_at_ = received;
  return true;
}

AttitudeFault AttitudeWatch::fault(SteadyTime now) const {
  const SteadyTime heard = last_ ? last_->received : started_;
  if (now - heard > kSilentAfter) {
    return bytes_at_ && now - *bytes_at_ < kSilentAfter ? AttitudeFault::garbage
                                                        : AttitudeFault::silent;
  }
  if (repeats_ >= kFrozenRepeats && last_->received - changed_ >= kFrozenAfter) {
    return AttitudeFault::frozen;
  }
  if (is_recent(leapt_at_, now)) return AttitudeFault::jumping;
  if (is_recent(gap_at_, now)) return AttitudeFault::gaps;
  const RateUnit unit = rates_.unit();
  if (unit != RateUnit::unknown && unit != RateUnit::as_stated) return AttitudeFault::rates;
  return AttitudeFault::none;
}

}  // namespace lifeline::ahrs
