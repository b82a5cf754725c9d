#include "agents/rplidar/line_watch.hpp"

#include <gmock/gmock.h>

namespace lifeline::rplidar {
namespace {

using std::chrono::milliseconds;

const SteadyTime kStart(std::chrono::seconds(1000));

/// A watch over a scan that has run well until `until`, a turn every 100 ms.
LineWatch well_until(SteadyTime until) {
  LineWatch watch;
  watch.start(kStart);
  for (SteadyTime t = kStart; t <= until; t += milliseconds(5)) {
    watch.note(t, true, (t - kStart) % milliseconds(100) == Duration{0});
  }
  return watch;
}

TEST(LineWatch, silence_is_seen_within_half_a_second) {
  const SteadyTime last = kStart + milliseconds(2000);
  const LineWatch watch = well_until(last);
  EXPECT_EQ(watch.fault(last + milliseconds(300)), LineFault::none);
  EXPECT_EQ(watch.fault(last + milliseconds(500)), LineFault::silent);
  EXPECT_LE(watch.deadline(), last + milliseconds(500));
}

TEST(LineWatch, bytes_without_samples_are_garbage) {
  const SteadyTime last = kStart + milliseconds(2000);
  LineWatch watch = well_until(last);
  for (int ms = 5; ms <= 450; ms += 5) watch.note(last + milliseconds(ms), false, false);
  EXPECT_EQ(watch.fault(last + milliseconds(450)), LineFault::garbage);
}

TEST(LineWatch, samples_without_turns_mean_that_the_rotor_stands) {
  const SteadyTime last = kStart + milliseconds(2000);
  LineWatch watch = well_until(last);
  for (int ms = 5; ms <= 500; ms += 5) watch.note(last + milliseconds(ms), true, false);
  EXPECT_EQ(watch.fault(last + milliseconds(500)), LineFault::stalled);
}

TEST(LineWatch, a_rotor_may_take_its_time_to_start) {
  LineWatch watch;
  watch.start(kStart);
  EXPECT_EQ(watch.fault(kStart + milliseconds(2900)), LineFault::none);
  EXPECT_EQ(watch.fault(kStart + milliseconds(3000)), LineFault::silent);
}

TEST(LineWatch, what_nobody_looked_for_is_not_missing) {
  const SteadyTime last = kStart + milliseconds(2000);
  LineWatch watch = well_until(last);
  watch.excuse(std::chrono::seconds(3));
  EXPECT_EQ(watch.fault(last + milliseconds(3300)), LineFault::none);
  EXPECT_EQ(watch.fault(last + milliseconds(3500)), LineFault::silent);
}

}  // namespace
}  // namespace lifeline::rplidar
