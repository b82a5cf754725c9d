#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/base/time.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::sensing {

/// How the head is held, as an attitude sensor says. Right-handed: x forward, y left, z up.
struct Attitude {
  double roll_rad = 0.0;   ///< about x
  double pitch_rad = 0.0;  ///< about y, nose down positive
  double yaw_rad = 0.0;    ///< about z, counter-clockwise, from an arbitrary zero
};

/// An attitude within a sweep.
struct TimedAttitude {
  Duration after_stamp{};  ///< the time from the sweep's stamp
  Attitude attitude;
};

/// How a live attitude sensor is, the worse the later. A source that never had one is good.
enum class AttitudeHealth {
  good,
  degraded,  ///< the attitude is old, or readings are missing: not to be relied on fully
  silent,    ///< nothing comes
  failed,    ///< unplugged, frozen, or nothing that can be read
};

/// What a detector on the helmet can tell apart.
enum class SightedKind { victim, uwb_tag };

/// A find as a detector on the helmet sees it, in the gravity-aligned head frame at the scan's
/// stamp.
struct Sighting {
  SightedKind kind = SightedKind::victim;
  Eigen::Vector2d p_head_m{0.0, 0.0};
  double sigma_m = 0.1;     ///< standard deviation of either coordinate
  double confidence = 0.5;  ///< that it is there at all, 0 to 1
};

/// One sweep of a lidar as its driver or a recording gives it.
struct RawScan {
  Timestamp stamp{};             ///< of the first beam, the sensor's clock
  Duration sweep_time{};         ///< from first to last beam, 0 = all at once
  double first_angle_rad = 0.0;  ///< of beam 0 in the laser frame, counter-clockwise
  double angle_step_rad = 0.0;   ///< from beam to beam; negative for a clockwise lidar
  double range_min_m = 0.0;
  double range_max_m = 0.0;     ///< at or beyond: nothing was hit
  std::vector<float> ranges_m;  ///< any value at all: 0, NaN and infinities mean "no reading"

  /// At the stamp. Only differences of its yaw mean anything; not finite: unknown, unlike roll and
  /// pitch.
  std::optional<Attitude> attitude;
  /// How the head moved on within the sweep, in ascending order of time; empty where that is not
  /// known. Only with `attitude`, and with the same zero of yaw.
  std::vector<TimedAttitude> later_attitudes;
  AttitudeHealth attitude_health = AttitudeHealth::good;
  std::optional<Pose2>
      T_odom_head;  ///< dead reckoning (wheels, legs), in a drifting frame of its own
  std::vector<Sighting> sightings;          ///< what a detector beside the lidar saw at the stamp
  std::optional<Pose2> T_world_head_truth;  ///< for judging only: no algorithm reads it
};

}  // namespace lifeline::sensing
