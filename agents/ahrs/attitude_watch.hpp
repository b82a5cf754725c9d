#pragma once

#include <cstdint>
#include <optional>

#include "agents/ahrs/ahrs_reading.hpp"
#include "agents/ahrs/rate_check.hpp"
#include "common/base/time.hpp"

namespace lifeline::ahrs {

/// What is wrong with an attitude sensor, the worst first.
enum class AttitudeFault {
  none,
  silent,   ///< nothing comes
  garbage,  ///< something comes, but no attitude that can be read
  frozen,   ///< the same reading again and again
  jumping,  ///< leaps that no head makes
  gaps,     ///< readings are missing, but not all
  rates,    ///< the rates are not in the unit that they should be in, or contradict the attitude
};

/// Watches what comes from an attitude sensor. Times and readings in, verdict out: knows no port.
class AttitudeWatch {
 public:
  static constexpr Duration kSilentAfter = std::chrono::milliseconds(500);
  static constexpr Duration kFrozenAfter = std::chrono::milliseconds(500);
  /// A gap, or a leap, is held against the sensor for this long.
  static constexpr Duration kRemembered = std::chrono::seconds(2);

  /// The port was opened: from now on something should come.
  void start(SteadyTime now);
  /// A reading, measured at `stamp` and there at `received` (a frozen sensor's own clock may
  /// stand); false where it must not be used (frozen, or a leap).
  [[nodiscard]] bool take(const AhrsReading& reading, SteadyTime stamp, SteadyTime received);
  void note_damaged() { ++counts_.damaged; }
  /// Bytes came, whatever they are.
  void note_bytes(SteadyTime now) { bytes_at_ = now; }

  [[nodiscard]] AttitudeFault fault(SteadyTime now) const;
  [[nodiscard]] RateUnit rate_unit() const { return rates_.unit(); }

  struct Counts {
    std::uint64_t readings = 0;
    std::uint64_t damaged = 0;
    std::uint64_t gaps = 0;  ///< more than 3 intervals, and more than 100 ms, without a reading
    std::uint64_t leaps = 0;
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool leaps(const AhrsReading& reading, SteadyTime stamp, SteadyTime received);

  SteadyTime started_{};
  struct Last {
    AhrsReading reading;
    SteadyTime stamp, received;
  };
  std::optional<Last> last_;
  SteadyTime changed_{};  ///< since when the reading has been the same
  int repeats_ = 0;
  int leaps_in_a_row_ = 0;
  double interval_s_ = 0.0;  ///< usual, between readings
  std::optional<SteadyTime> bytes_at_, gap_at_, leapt_at_;
  RateCheck rates_;
  Counts counts_;
};

}  // namespace lifeline::ahrs
