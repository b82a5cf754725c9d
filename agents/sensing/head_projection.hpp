#pragma once

#include "agents/sensing/raw_scan.hpp"
#include "common/grid/scan2.hpp"

namespace lifeline::sensing {

/// What Eq. 14 has to know of the helmet and the building.
struct ProjectionConfig {
  double max_range_m = 30.0;      ///< readings beyond are taken for "nothing was hit"
  double sensor_height_m = 1.8;   ///< h1: lidar above the floor
  double ceiling_height_m = 2.5;  ///< h_c: ceiling above the floor
  double height_margin_m = 0.15;  ///< a reading that ends closer to floor or ceiling is not a wall
  double max_tilt_rad = 1.0;      ///< a head held steeper than this sees nothing of use
};

/// Eq. 14 for pitch and roll: brings each beam into the gravity-aligned head frame.
///
/// A beam's direction in space follows from its angle in the laser and the attitude. If it would
/// meet the floor (or the ceiling) before its reading ends, it is invalid: it shows no wall. Else
/// it is projected onto the horizontal plane. The paper's two bounds are the case of pitch alone.
/// Without attitude the head is taken to be level. A reading of 0, below the lidar's range,
/// negative or not finite is invalid; one at or beyond the lidar's range (or max_range_m) is a
/// no-return. Never fails: a scan nothing can be made of gives beams that are all invalid, or none.
[[nodiscard]] Scan2 project_scan(const RawScan& raw, const ProjectionConfig& config);

}  // namespace lifeline::sensing
