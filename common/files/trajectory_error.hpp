#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::files {

/// How far an estimated trajectory is from the truth.
struct TrajectoryError {
  std::size_t poses = 0;   ///< of the estimate that were compared
  std::size_t lost = 0;    ///< of the estimate for whose time no truth is known
  Pose2 T_truth_estimate;  ///< the alignment: takes the estimate's coordinates to the truth's
  double rmse_m = 0.0;
  double max_m = 0.0;
  double rmse_rad = 0.0;
  double max_rad = 0.0;
};

/// Compares after the best rigid alignment in the plane: both live in frames of their own. Each
/// pose of the estimate meets the truth at its time, interpolated between two true poses at most
/// `max_gap` apart. The alignment minimises the squared errors of position (m) and of heading
/// (rad), the latter counted a quarter. bad_data when
/// fewer than ten poses meet a truth, or when the truth is not ordered by time.
[[nodiscard]] Result<TrajectoryError> trajectory_error(
    std::span<const StampedPose> estimate, std::span<const StampedPose> truth,
    Duration max_gap = std::chrono::milliseconds(200));

}  // namespace lifeline::files
