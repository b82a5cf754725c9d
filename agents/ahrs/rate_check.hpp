#pragma once

#include <optional>

#include "agents/ahrs/ahrs_reading.hpp"
#include "common/base/time.hpp"

namespace lifeline::ahrs {

/// What a sensor's rates turn out to be, against how its attitude changes.
enum class RateUnit {
  unknown,     ///< has not turned enough yet, or gives no rates
  as_stated,   ///< rates and attitude agree
  degrees,     ///< said to be radians, but degrees (57.3 times too large)
  radians,     ///< said to be degrees, but radians (57.3 times too small)
  per_sample,  ///< said to be per second, but per interval between samples
  disagree,    ///< nothing that makes them agree: axes mixed up, or a broken sensor
};

/// Integrates the rates from reading to reading and compares with the attitude's change. Rates are
/// used for nothing else: a wrong unit tells of a sensor that is set up otherwise than believed.
class RateCheck {
 public:
  static constexpr double kEnoughRad = 1.0;  ///< of turning, before anything is said

  /// One more reading, measured at `stamp`. Longer gaps than kLongest are passed over.
  void add(const AhrsReading& reading, SteadyTime stamp);
  /// The last verdict. It is renewed with each kEnoughRad of turning, and changes once the new one
  /// came twice in a row: a damaged number decides nothing.
  [[nodiscard]] RateUnit unit() const { return unit_; }
  /// For a sensor that was restarted.
  void reset() { *this = {}; }

 private:
  static constexpr Duration kLongest = std::chrono::milliseconds(200);
  void judge();

  struct Last {
    AhrsReading reading;
    SteadyTime stamp;
  };
  std::optional<Last> last_;
  double turned_rad_ = 0.0;           // by the attitude, all steps added up
  double both_ = 0.0;                 // sum over steps of turn * integrated rate
  double turn2_ = 0.0, rate2_ = 0.0;  // of their squares
  double seconds_ = 0.0;
  int steps_ = 0;
  RateUnit newest_ = RateUnit::unknown, unit_ = RateUnit::unknown;
};

}  // namespace lifeline::ahrs
