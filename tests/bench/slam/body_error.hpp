#pragma once

#include <span>

#include "common/base/result.hpp"
#include "common/files/trajectory_error.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::bench {

/// A trajectory against that of another body on the same vehicle.
struct BodyError {
  files::TrajectoryError error;  ///< with the body's place fitted
  Pose2 T_estimated_reference;   ///< the reference's body in the estimate's: fitted
};

/// As files::trajectory_error(), but the fixed transform between the two tracked bodies (motion
/// capture marker and lidar) is fitted as well.
[[nodiscard]] Result<BodyError> body_error(std::span<const StampedPose> estimate,
                                           std::span<const StampedPose> truth);

/// Heading gained or lost against the truth from the first second to the last, in degrees per metre
/// of the true way. Poses meet by their place in the lists, which must be of the same length.
[[nodiscard]] double heading_drift_deg_per_m(std::span<const StampedPose> estimate,
                                             std::span<const StampedPose> truth);

}  // namespace lifeline::bench
