#include "agents/ahrs/ahrs_reading.hpp"

#include <cmath>

namespace lifeline::ahrs {

Eigen::Quaterniond from_ned(const Eigen::Quaterniond& R_ned_frd) {
  // East, north, up from north, east, down: a half turn about the axis between north and east.
  const double half = std::sqrt(0.5);
  const Eigen::Quaterniond R_enu_ned(0.0, half, half, 0.0);
  const Eigen::Quaterniond R_frd_flu(0.0, 1.0, 0.0, 0.0);  // a half turn about x
  return R_enu_ned * R_ned_frd * R_frd_flu;
}

Eigen::Vector3d from_frd(const Eigen::Vector3d& frd) {
  return {frd.x(), -frd.y(), -frd.z()};
}

}  // namespace lifeline::ahrs
