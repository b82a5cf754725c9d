#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "common/base/result.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::bench {

/// Relative pose errors of a trajectory (Kuemmerle et al., Autonomous Robots 27(4), 2009): no
/// alignment of frames is needed.
struct RelationsError {
  std::size_t judged = 0;
  std::size_t lost = 0;  ///< relations with a time more than 10 s from any pose
  double translation_mean_m = 0.0;
  double translation_std_m = 0.0;
  double rotation_mean_deg = 0.0;
  double rotation_std_deg = 0.0;
};

/// `relations`: lines `t1 t2 x y z roll pitch yaw`, the pose at t2 seen from that at t1.
/// `odometry`: a CARMEN log whose ODOM and FLASER lines hold the wheels' poses; they carry the pose
/// of the last scan to a relation's time, X(t) = X_k W_k^-1 W(t). All times are on the log's clock,
/// plain or gzip-compressed files. bad_data with file and line for anything malformed, and where
/// there are fewer than two poses.
[[nodiscard]] Result<RelationsError> relations_error(std::span<const StampedPose> estimate,
                                                     const std::filesystem::path& relations,
                                                     const std::filesystem::path& odometry);

}  // namespace lifeline::bench
