#include "tests/bench/slam/body_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "common/base/check.hpp"

namespace lifeline::bench {
namespace {

std::vector<StampedPose> moved(std::span<const StampedPose> poses, const Pose2& T_body_other) {
  std::vector<StampedPose> others;
  for (const StampedPose& pose : poses) others.push_back({pose.stamp, pose.pose * T_body_other});
  return others;
}

Pose2 to_pose(const Eigen::Vector3d& body) {
  return {body.x(), body.y(), body.z()};
}

/// What the alignment minimises, too.
double cost_of(const files::TrajectoryError& error) {
  constexpr double kHeadingWeight = 0.25;
  return error.rmse_m * error.rmse_m + kHeadingWeight * error.rmse_rad * error.rmse_rad;
}

template <typename Cost>
Eigen::Vector3d newton_step(const Cost& cost, const Eigen::Vector3d& at) {
  constexpr double kStep = 2e-3;  // metres and radians
  const auto moved_by = [&](int axis, double side) {
    return Eigen::Vector3d(at + side * kStep * Eigen::Vector3d::Unit(axis));
  };
  const double here = cost(at);
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    const double up = cost(moved_by(i, 1.0)), down = cost(moved_by(i, -1.0));
    gradient(i) = (up - down) / (2.0 * kStep);
    hessian(i, i) = (up - 2.0 * here + down) / (kStep * kStep);
    for (int k = 0; k < i; ++k) {
      const Eigen::Vector3d across = kStep * Eigen::Vector3d::Unit(k);
      hessian(i, k) = hessian(k, i) =
          (cost(moved_by(i, 1.0) + across) - cost(moved_by(i, 1.0) - across) -
           cost(moved_by(i, -1.0) + across) + cost(moved_by(i, -1.0) - across)) /
          (4.0 * kStep * kStep);
    }
  }
  return -hessian.ldlt().solve(gradient);
}

}  // namespace

/// Newton's method on the body's three numbers, derivatives by differences; the alignment of the
/// frames is solved for each.
Result<BodyError> body_error(std::span<const StampedPose> estimate,
                             std::span<const StampedPose> truth) {
  constexpr int kMostSteps = 20;
  if (const auto first = files::trajectory_error(estimate, truth); !first) {
    return forward_error(first);
  }
  const auto cost = [&](const Eigen::Vector3d& body) {
    return cost_of(*files::trajectory_error(moved(estimate, to_pose(body)), truth));
  };
  Eigen::Vector3d body = Eigen::Vector3d::Zero();
  for (int i = 0; i < kMostSteps; ++i) {
    const double before = cost(body);
    Eigen::Vector3d step = newton_step(cost, body);
    while (step.norm() > 1e-7 && cost(body + step) >= before) step *= 0.5;
    if (step.norm() <= 1e-7) break;
    body += step;
  }
  const Pose2 T_estimated_reference = to_pose(body);
  const auto error = files::trajectory_error(moved(estimate, T_estimated_reference), truth);
  if (!error) return forward_error(error);
  return BodyError{*error, T_estimated_reference};
}

double heading_drift_deg_per_m(std::span<const StampedPose> estimate,
                               std::span<const StampedPose> truth) {
  LIFELINE_CHECK(estimate.size() == truth.size());
  constexpr std::size_t kMeanOver = 10;
  const std::size_t count = std::min(kMeanOver, estimate.size());
  if (count == 0) return 0.0;
  const auto off_rad = [&](std::size_t i) {
    return normalise_angle(estimate[i].pose.yaw_rad - truth[i].pose.yaw_rad);
  };
  double way_m = 0.0, gained_rad = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    way_m += (truth[i].pose.translation() - truth[i - 1].pose.translation()).norm();
  }
  for (std::size_t i = 0; i < count; ++i) {
    gained_rad += normalise_angle(off_rad(estimate.size() - count + i) - off_rad(i));
  }
  if (way_m == 0.0) return 0.0;
  return std::abs(gained_rad) / static_cast<double>(count) * 180.0 / std::numbers::pi / way_m;
}

}  // namespace lifeline::bench
