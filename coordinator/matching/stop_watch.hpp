#pragma once

#include <ctime>

namespace lifeline::matching {

/// CPU time of this thread for the steps of a match: other load on the machine does not count.
class StopWatch {
 public:
  /// Milliseconds since the last call, or since it was made.
  [[nodiscard]] double lap_ms() {
    const double now = now_ms(), lap = now - last_ms_;
    last_ms_ = now;
    return lap;
  }

 private:
  static double now_ms() {
    std::timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double last_ms_ = now_ms();
};

}  // namespace lifeline::matching
