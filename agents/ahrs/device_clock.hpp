#pragma once

#include <optional>

#include "common/base/time.hpp"

namespace lifeline::ahrs {

/// From a sensor's own time to this process's steady clock.
///
/// A message is never received before it was sent, and some are received almost at once: the
/// smallest difference of the two times seen is the offset, allowed to grow by kMostDrift so that a
/// slow clock is followed. A device time that goes back, or is off by more than kMostDelay, is a
/// sensor that was restarted: the offset is found anew.
class DeviceClock {
 public:
  static constexpr double kMostDrift = 200e-6;
  static constexpr Duration kMostDelay = std::chrono::seconds(1);

  /// When the message was measured. `received`: when its first byte can have come, at the earliest.
  /// Without a device time that is all that is known. Never after `received`.
  [[nodiscard]] SteadyTime to_steady(std::optional<Duration> device_time, SteadyTime received);

 private:
  struct Known {
    Duration device_time;
    Duration offset;  ///< steady clock minus device time
  };
  std::optional<Known> known_;
};

}  // namespace lifeline::ahrs
