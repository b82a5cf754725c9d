#include "deploy/demo/judge_trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/files/trajectory_error.hpp"
#include "common/files/tum.hpp"
#include "deploy/demo/merge_error.hpp"

namespace lifeline::demo {
namespace {

/// What two writings of one time may differ by.
constexpr Duration kSameTime = std::chrono::milliseconds(1);

std::optional<Pose2> first_map_pose(const std::vector<StampedPose>& estimate,
                                    const std::vector<StampedPose>& truth) {
  for (const StampedPose& pose : estimate) {
    const auto same = std::ranges::find_if(truth, [&](const StampedPose& true_pose) {
      return std::chrono::abs(true_pose.stamp - pose.stamp) <= kSameTime;
    });
    if (same != truth.end()) return true_map_pose(same->pose, pose.pose);
  }
  return std::nullopt;
}

}  // namespace

TrajectoryVerdict judge_trajectory(const std::filesystem::path& estimate,
                                   const std::filesystem::path& truth) {
  const auto estimated = files::read_tum(estimate);
  auto true_poses = files::read_tum(truth);
  if (!estimated || !true_poses) return {};
  TrajectoryVerdict verdict;
  verdict.T_world_map = first_map_pose(*estimated, *true_poses);
  std::ranges::stable_sort(*true_poses, {}, &StampedPose::stamp);  // recorded times may go back
  if (const auto error = files::trajectory_error(*estimated, *true_poses)) {
    verdict.rmse_m = error->rmse_m;
  }
  return verdict;
}

}  // namespace lifeline::demo
