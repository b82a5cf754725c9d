#include "agents/ahrs/device_clock.hpp"

#include <algorithm>

namespace lifeline::ahrs {

SteadyTime DeviceClock::to_steady(std::optional<Duration> device_time, SteadyTime received) {
  if (!device_time) return received;
  const Duration seen = received.time_since_epoch() - *device_time;
  if (!known_ || *device_time < known_->device_time || seen - known_->offset > kMostDelay) {
    known_ = {*device_time, seen};
    return received;
  }
  const Duration drifted =
      from_seconds(kMostDrift * to_seconds(*device_time - known_->device_time));
  known_ = {*device_time, std::min(known_->offset + drifted, seen)};
  return SteadyTime(*device_time + known_->offset);
}

}  // namespace lifeline::ahrs
