#include "common/files/trajectory_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

namespace lifeline::files {
namespace {

struct Pair {
  Pose2 estimate, truth;
};

/// The truth at a time: a pose within 1 ms of it, or between two neighbours that are close enough.
std::optional<Pose2> truth_at(std::span<const StampedPose> truth, Timestamp stamp,
                              Duration max_gap) {
  constexpr auto kSame = std::chrono::milliseconds(1);
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), stamp,
                       [](const StampedPose& pose, Timestamp time) { return pose.stamp < time; });
  if (after != truth.end() && after->stamp - stamp < kSame) return after->pose;
  if (after == truth.begin() || after == truth.end()) return std::nullopt;
  const StampedPose& a = *std::prev(after);
  const StampedPose& b = *after;
  if (b.stamp - a.stamp > max_gap) return std::nullopt;
  const double u = to_seconds(stamp - a.stamp) / to_seconds(b.stamp - a.stamp);
  const double turn = normalise_angle(b.pose.yaw_rad - a.pose.yaw_rad);
  return Pose2{a.pose.x_m + u * (b.pose.x_m - a.pose.x_m),
               a.pose.y_m + u * (b.pose.y_m - a.pose.y_m),
               normalise_angle(a.pose.yaw_rad + u * turn)};
}

/// From the mean difference of heading and the centroids: where the refinement starts.
Pose2 first_alignment(const std::vector<Pair>& pairs) {
  double sine = 0.0, cosine = 0.0;
  Eigen::Vector2d of_truth(0.0, 0.0), of_estimate(0.0, 0.0);
  for (const auto& [estimate, truth] : pairs) {
    sine += std::sin(truth.yaw_rad - estimate.yaw_rad);
    cosine += std::cos(truth.yaw_rad - estimate.yaw_rad);
    of_truth += truth.translation();
    of_estimate += estimate.translation();
  }
  const Pose2 turned{0.0, 0.0, std::atan2(sine, cosine)};
  const Eigen::Vector2d shift =
      (of_truth - turned * of_estimate) / static_cast<double>(pairs.size());
  return {shift.x(), shift.y(), turned.yaw_rad};
}

/// One Gauss-Newton step of the alignment. Position errors are taken in the truth's frame: the
/// squares are the same as in the helmet's.
Eigen::Vector3d refine(const std::vector<Pair>& pairs, const Pose2& T_truth_estimate) {
  constexpr double kHeadingWeight = 0.25;
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const auto& [estimate, truth] : pairs) {
    const Eigen::Vector2d p = T_truth_estimate * estimate.translation();
    const Eigen::Vector2d arm = p - T_truth_estimate.translation();
    Eigen::Matrix<double, 2, 3> slope;
    slope << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
    hessian += slope.transpose() * slope;
    gradient += slope.transpose() * (p - truth.translation());
    hessian(2, 2) += kHeadingWeight;
    gradient(2) += kHeadingWeight *
                   normalise_angle(T_truth_estimate.yaw_rad + estimate.yaw_rad - truth.yaw_rad);
  }
  return -hessian.inverse() * gradient;
}

TrajectoryError judge(const std::vector<Pair>& pairs, const Pose2& T_truth_estimate) {
  TrajectoryError error;
  error.poses = pairs.size();
  error.T_truth_estimate = T_truth_estimate;
  for (const auto& [estimate, truth] : pairs) {
    const Pose2 off = truth.inverse() * (T_truth_estimate * estimate);
    const double distance = off.translation().norm(), turn = std::abs(off.yaw_rad);
    error.rmse_m += distance * distance;
    error.rmse_rad += turn * turn;
    error.max_m = std::max(error.max_m, distance);
    error.max_rad = std::max(error.max_rad, turn);
  }
  error.rmse_m = std::sqrt(error.rmse_m / static_cast<double>(pairs.size()));
  error.rmse_rad = std::sqrt(error.rmse_rad / static_cast<double>(pairs.size()));
  return error;
}

}  // namespace

Result<TrajectoryError> trajectory_error(std::span<const StampedPose> estimate,
                                         std::span<const StampedPose> truth, Duration max_gap) {
  constexpr std::size_t kFewest = 10;
  constexpr int kSteps = 20;
  if (!std::is_sorted(truth.begin(), truth.end(), [](const StampedPose& a, const StampedPose& b) {
        return a.stamp < b.stamp;
      })) {
    return fail(ErrorCode::bad_data, "the true poses are not in the order of time; sort them");
  }
  std::vector<Pair> pairs;
  for (const auto& [stamp, pose] : estimate) {
    if (const auto known = truth_at(truth, stamp, max_gap)) pairs.push_back({pose, *known});
  }
  if (pairs.size() < kFewest) {
    return fail(ErrorCode::bad_data,
                "only {} of {} poses have a true pose at their time, {} are needed; compare with "
                "the truth of the same run",
                pairs.size(), estimate.size(), kFewest);
  }
  Pose2 aligned = first_alignment(pairs);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d step = refine(pairs, aligned);
    aligned = {aligned.x_m + step.x(), aligned.y_m + step.y(),
               normalise_angle(aligned.yaw_rad + step.z())};
    if (step.cwiseAbs().maxCoeff() < 1e-9) break;
  }
  TrajectoryError error = judge(pairs, aligned);
  error.lost = estimate.size() - pairs.size();
  return error;
}

}  // namespace lifeline::files
