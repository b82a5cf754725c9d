#include "agents/slam/pose_graph.hpp"

#include <array>
#include <memory>

#include <ceres/ceres.h>

#include "common/base/check.hpp"
#include "common/grid/relative_pose_error.hpp"

namespace lifeline::slam {
namespace {

using Parameters = std::array<double, 3>;  // x, y, yaw

void add_edges(std::span<const GraphEdge> edges, double loss_scale, std::vector<Parameters>& x,
               ceres::Problem& problem) {
  for (const GraphEdge& edge : edges) {
    LIFELINE_CHECK(edge.from < x.size() && edge.to < x.size() && edge.from != edge.to);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<RelativePoseError, 3, 3, 3>(
                                 new RelativePoseError(edge.T_from_to, edge.covariance)),
                             edge.may_be_wrong ? new ceres::CauchyLoss(loss_scale) : nullptr,
                             x[edge.from].data(), x[edge.to].data());
  }
}

}  // namespace

void optimise(std::vector<Pose2>& poses, std::span<const GraphEdge> edges,
              const GraphConfig& config) {
  if (poses.size() < 2 || edges.empty()) return;
  std::vector<Parameters> x;
  x.reserve(poses.size());
  for (const Pose2& pose : poses) x.push_back({pose.x_m, pose.y_m, pose.yaw_rad});
  ceres::Problem problem;
  add_edges(edges, config.loss_scale, x, problem);
  problem.AddParameterBlock(x.front().data(), 3);
  problem.SetParameterBlockConstant(x.front().data());

  ceres::Solver::Options options;
  options.max_num_iterations = config.max_iterations;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Eigen's own factorisation: one thread, the same result in each run.
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = {x[i][0], x[i][1], normalise_angle(x[i][2])};
  }
}

}  // namespace lifeline::slam
