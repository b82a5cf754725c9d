#pragma once

#include <numbers>

#include <Eigen/Core>

#include "agents/sensing/raw_scan.hpp"
#include "common/grid/scan2.hpp"

namespace lifeline::sensing {

/// How the lidar sits on the head. Axes and signs as in Attitude, of a head held level.
struct LidarMount {
  double roll_rad = 0.0;  ///< R_body_laser = Rz(yaw) Ry(pitch) Rx(roll)
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
  /// From the point about which the head leans, the neck, to the lidar.
  Eigen::Vector3d lever_body_m = Eigen::Vector3d::Zero();
};

/// What Eq. 14 has to know of the helmet and the building.
struct ProjectionConfig {
  double max_range_m = 30.0;      ///< readings beyond are taken for "nothing was hit"
  double sensor_height_m = 1.7;   ///< h1: lidar above the floor, the head held level
  double ceiling_height_m = 2.7;  ///< h_c: ceiling above the floor
  /// A reading that ends closer to floor or ceiling than height_margin_m plus this share of its
  /// range is not taken for a wall: heights and attitude are never known exactly.
  double height_margin_m = 0.15;
  double tilt_margin_rad = 0.6 * std::numbers::pi / 180.0;
  double max_tilt_rad = 1.0;  ///< a head held steeper than this sees nothing of use
  LidarMount mount;
};

/// Eq. 14 for pitch and roll: brings each beam into the gravity-aligned head frame.
///
/// A beam's origin and direction in space follow from its angle in the laser, the mount and the
/// attitude at the beam's own time (attitude, then later_attitudes in between which it is
/// interpolated). If it would meet the floor (or the ceiling) before its reading ends, it is
/// invalid: it shows no wall. Else it is projected onto the horizontal plane. The paper's two
/// bounds are the case of pitch alone, straight ahead. The head frame stands where the lidar is
/// when the head is level, and keeps the heading of the stamp; with later_attitudes the head's turn
/// within the sweep is undone and Scan2::turn_undone says so.
///
/// Without attitude the head is taken to be level. A reading of 0, below the lidar's range,
/// negative or not finite is invalid; one at or beyond the lidar's range (or max_range_m) is a
/// no-return. A beam taken while the head was steeper than max_tilt_rad is invalid. Never fails: a
/// scan nothing can be made of gives beams that are all invalid, or none.
[[nodiscard]] Scan2 project_scan(const RawScan& raw, const ProjectionConfig& config);

}  // namespace lifeline::sensing
