#include "deploy/demo/judge_trajectory.hpp"

#include <algorithm>

#include "common/files/trajectory_error.hpp"
#include "common/files/tum.hpp"

namespace lifeline::demo {
TrajectoryVerdict judge_trajectory(const std::filesystem::path& estimate,
                                   const std::filesystem::path& truth) {
  const auto estimated = files::read_tum(estimate);
  auto true_poses = files::read_tum(truth);
  if (!estimated || !true_poses) return {};
  TrajectoryVerdict verdict;
  std::ranges::stable_sort(*true_poses, {}, &StampedPose::stamp);  // recorded times may go back
  if (const auto error = files::trajectory_error(*estimated, *true_poses)) {
    verdict.rmse_m = error->rmse_m;
    verdict.T_world_map = error->T_truth_estimate;
  }
  return verdict;
}

}  // namespace lifeline::demo
