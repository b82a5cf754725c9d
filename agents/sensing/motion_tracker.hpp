#pragma once

#include <optional>

#include "agents/sensing/raw_scan.hpp"

namespace lifeline::sensing {

/// What the sensors beside the lidar say of the motion between two scans.
struct SensedMotion {
  Duration elapsed{};                   ///< 0 or less: the clock stood or went back
  std::optional<Pose2> T_previous_now;  ///< from dead reckoning, if both scans have it
  std::optional<double> yaw_step_rad;   ///< from the attitude, if both scans have it
  Duration sweep{};                     ///< from the scan's first beam to its last
};

/// Keeps the last scan's dead reckoning and attitude and gives the differences.
class MotionTracker {
 public:
  /// The motion from the scan given last to `raw`; nothing known at the first. Values that are not
  /// finite are taken for missing.
  [[nodiscard]] SensedMotion next(const RawScan& raw);

 private:
  bool started_ = false;
  Timestamp stamp_{};
  std::optional<Pose2> T_odom_head_;
  std::optional<double> yaw_rad_;
};

}  // namespace lifeline::sensing
