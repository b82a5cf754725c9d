#pragma once

#include <cstddef>
#include <vector>

#include "agents/sensing/motion_tracker.hpp"
#include "agents/sensing/raw_scan.hpp"

namespace lifeline::slam {

struct ScanCheckConfig {
  std::size_t min_readings = 30;  ///< fewer tell nothing of a sweep that stands still
  double frozen_turn_rad = 0.01;  ///< the head turned this far, and the sweep stayed the same ...
  double frozen_way_m = 0.03;     ///< ... or went this far
  double sparse_share = 0.5;      ///< of the readings that sweeps had so far, on average
  double memory_scans = 50.0;     ///< that the average is taken over, about
  double changed_share = 0.1;     ///< by which the number of beams may change unremarked
};

/// What is wrong with a sweep as a whole. Nothing of this is normal, all of it happens.
struct ScanFaults {
  bool frozen = false;         ///< the lidar repeats itself while the head moves: not to be used
  bool sparse = false;         ///< far fewer readings than usual
  bool clock_stood = false;    ///< not later than the sweep before
  bool beams_changed = false;  ///< another number of beams than the sweep before

  [[nodiscard]] bool any() const { return frozen || sparse || clock_stood || beams_changed; }
};

/// Whether less is to be trusted in what a sweep's match says: for the sweep, or for its attitude.
[[nodiscard]] inline bool is_doubtful(const ScanFaults& faults, const sensing::RawScan& raw) {
  return faults.any() || raw.attitude_health != sensing::AttitudeHealth::good;
}

/// Compares each sweep with the ones before. A sweep that repeats the last one to the bit is
/// believed as long as the head stands still for all that is known. One owner.
class ScanCheck {
 public:
  explicit ScanCheck(ScanCheckConfig config = {}) : config_(config) {}

  /// One more sweep; `motion` as the sensors beside the lidar tell it, since the last.
  [[nodiscard]] ScanFaults next(const sensing::RawScan& raw, const sensing::SensedMotion& motion);

 private:
  [[nodiscard]] bool is_frozen(const sensing::RawScan& raw, const sensing::SensedMotion& motion,
                               std::size_t readings);

  ScanCheckConfig config_;
  bool started_ = false;
  std::vector<float> last_ranges_m_;
  double usual_readings_ = 0.0;
  bool frozen_ = false;      ///< once seen, until the sweep changes
  double turned_rad_ = 0.0;  ///< since the sweep that is repeated
  Pose2 T_first_now_;        ///< the same by dead reckoning
};

}  // namespace lifeline::slam
