#pragma once

#include <chrono>

namespace lifeline {

using Duration = std::chrono::nanoseconds;
/// A sensor's or sender's own wall clock. Never compared across machines.
using Timestamp = std::chrono::time_point<std::chrono::system_clock, Duration>;
/// This process's monotonic clock: ages, deadlines, pacing.
using SteadyTime = std::chrono::time_point<std::chrono::steady_clock, Duration>;

/// Where a state machine takes its time from, so that tests and the simulated fleet can own it.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual SteadyTime steady_now() const = 0;
  [[nodiscard]] virtual Timestamp wall_now() const = 0;
};

class SystemClock final : public Clock {
 public:
  [[nodiscard]] SteadyTime steady_now() const override { return std::chrono::steady_clock::now(); }
  [[nodiscard]] Timestamp wall_now() const override { return std::chrono::system_clock::now(); }
};

/// A clock that stands still until told otherwise.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] SteadyTime steady_now() const override { return SteadyTime(elapsed_); }
  [[nodiscard]] Timestamp wall_now() const override { return Timestamp(elapsed_); }
  void advance(Duration by) { elapsed_ += by; }

 private:
  Duration elapsed_{std::chrono::hours(1)};
};

[[nodiscard]] constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

[[nodiscard]] constexpr Duration from_seconds(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace lifeline
