#include "coordinator/merging/refine_places.hpp"

#include <array>
#include <utility>

#include <ceres/ceres.h>

#include "common/base/check.hpp"
#include "common/grid/relative_pose_error.hpp"

namespace lifeline::merging {
namespace {

constexpr double kLossScale = 3.0;  // in standard deviations
constexpr int kMaxIterations = 20;

using Parameters = std::array<double, 3>;  // x, y, yaw

void add_edges(std::span<const PlaceEdge> edges, std::vector<Parameters>& x,
               ceres::Problem& problem) {
  for (const PlaceEdge& edge : edges) {
    LIFELINE_CHECK(edge.a < x.size() && edge.b < x.size() && edge.a != edge.b);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<RelativePoseError, 3, 3, 3>(
                                 new RelativePoseError(edge.T_a_b, edge.covariance)),
                             new ceres::HuberLoss(kLossScale), x[edge.a].data(), x[edge.b].data());
  }
  problem.SetParameterBlockConstant(x.front().data());
}

void solve(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.max_num_iterations = kMaxIterations;
  // A few dozen unknowns on one thread: quick, and the same result in each run.
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

/// The inverse of the normal equations, place by place.
std::vector<Eigen::Matrix3d> covariances(ceres::Problem& problem, std::vector<Parameters>& x) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> blocks;
  for (std::size_t i = 1; i < x.size(); ++i) blocks.emplace_back(x[i].data(), x[i].data());
  std::vector<Eigen::Matrix3d> all(x.size(), Eigen::Matrix3d::Zero());
  if (!covariance.Compute(blocks, &problem)) return all;
  for (std::size_t i = 1; i < x.size(); ++i) {
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block;
    covariance.GetCovarianceBlock(x[i].data(), x[i].data(), block.data());
    all[i] = block;
  }
  return all;
}

}  // namespace

RefinedPlaces refine_places(const std::vector<Pose2>& start, std::span<const PlaceEdge> edges) {
  LIFELINE_CHECK(start.size() > 1 && edges.size() + 1 >= start.size());
  std::vector<Parameters> x;
  x.reserve(start.size());
  for (const Pose2& pose : start) x.push_back({pose.x_m, pose.y_m, pose.yaw_rad});
  ceres::Problem problem;
  add_edges(edges, x, problem);
  RefinedPlaces refined{start, {}};
  // Without a cycle nothing has to give way: the start meets every edge.
  if (edges.size() >= start.size()) {
    solve(problem);
    for (std::size_t i = 0; i < x.size(); ++i)
      refined.T_common_map[i] = {x[i][0], x[i][1], normalise_angle(x[i][2])};
  }
  refined.covariance = covariances(problem, x);
  return refined;
}

}  // namespace lifeline::merging
