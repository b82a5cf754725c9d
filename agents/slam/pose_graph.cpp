#include "agents/slam/pose_graph.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {

using Parameters = std::array<double, 3>;  // x, y, yaw

/// The matrix that turns an error into standard deviations.
Eigen::Matrix3d whitening(const Eigen::Matrix3d& covariance) {
  const Eigen::LLT<Eigen::Matrix3d> root(covariance.inverse());
  LIFELINE_CHECK(root.info() == Eigen::Success);
  return root.matrixU();
}

template <typename T>
T wrapped(const T& angle_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle_rad - kTurn * ceres::floor((angle_rad + std::numbers::pi) / kTurn);
}

/// How far the second pose, seen from the first, is from where the edge says.
struct EdgeError {
  Pose2 T_from_to;
  Eigen::Matrix3d whiten;

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    const T c = ceres::cos(from[2]), s = ceres::sin(from[2]);
    const T dx = to[0] - from[0], dy = to[1] - from[1];
    const Eigen::Matrix<T, 3, 1> error(c * dx + s * dy - T_from_to.x_m,
                                       c * dy - s * dx - T_from_to.y_m,
                                       wrapped(T(to[2] - from[2] - T_from_to.yaw_rad)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>(residual).noalias() = whiten.cast<T>() * error;
    return true;
  }
};

void add_edges(std::span<const GraphEdge> edges, double loss_scale, std::vector<Parameters>& x,
               ceres::Problem& problem) {
  for (const GraphEdge& edge : edges) {
    LIFELINE_CHECK(edge.from < x.size() && edge.to < x.size() && edge.from != edge.to);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeError, 3, 3, 3>(
                                 new EdgeError{edge.T_from_to, whitening(edge.covariance)}),
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
