#pragma once

#include <algorithm>
#include <stop_token>

#include "agents/serial/stop_event.hpp"
#include "common/base/time.hpp"

namespace lifeline::serial {

/// The waits between attempts to get a device back: short at first, each twice as long as the one
/// before, up to half a second. A stop request ends them at once.
class RetryWait {
 public:
  explicit RetryWait(const std::stop_token& stop) : stop_(stop) {}

  void wait() {
    stop_.wait(next_);
    next_ = std::min(2 * next_, kLongest);
  }
  /// The device is back.
  void reset() { next_ = kFirst; }

 private:
  static constexpr Duration kFirst = std::chrono::milliseconds(50);
  static constexpr Duration kLongest = std::chrono::milliseconds(500);

  StopEvent stop_;
  Duration next_ = kFirst;
};

}  // namespace lifeline::serial
