#pragma once

#include <Eigen/Geometry>

namespace lifeline::sensing {

/// Rz(yaw) Ry(pitch) Rx(roll): rolled, then pitched, then turned. Signs as in Attitude.
[[nodiscard]] inline Eigen::Quaterniond rotation_zyx(double roll_rad, double pitch_rad,
                                                     double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

}  // namespace lifeline::sensing
