#pragma once

#include "common/base/time.hpp"

namespace lifeline::rplidar {

/// What is wrong with a scan that runs.
enum class LineFault {
  none,
  silent,   ///< nothing comes any more
  garbage,  ///< bytes come, but nothing that can be read
  stalled,  ///< samples come, but the rotor does not turn
};

/// Watches whether a scan goes on. Times in, verdict out.
class LineWatch {
 public:
  /// Samples come at least every few milliseconds. Early enough that the helmet knows within half a
  /// second.
  static constexpr Duration kSilence = std::chrono::milliseconds(400);
  /// A turn at 2 Hz, less than half of the slowest speed that a lidar is run at.
  static constexpr Duration kSlowestTurn = std::chrono::milliseconds(500);
  /// A rotor that stood needs this long until it measures.
  static constexpr Duration kSpinUp = std::chrono::milliseconds(3000);

  /// The scan was started.
  void start(SteadyTime now);
  /// Something was read: any bytes, and with them samples, and with them whole turns.
  void note(SteadyTime now, bool samples, bool turned);
  /// Nobody looked for that long: what did not come in the meantime is not missing.
  void excuse(Duration away);

  [[nodiscard]] LineFault fault(SteadyTime now) const;
  /// When fault() is to be asked at the latest.
  [[nodiscard]] SteadyTime deadline() const;

 private:
  SteadyTime bytes_until_{}, samples_until_{}, turns_until_{};
};

}  // namespace lifeline::rplidar
