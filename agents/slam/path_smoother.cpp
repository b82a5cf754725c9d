#include "agents/slam/path_smoother.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace lifeline::slam {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// Of a direction in which a scan tells nothing: keeps its information invertible.
constexpr double kUnseenSigma_m = 30.0;
constexpr double kCertainSigma_m = 0.001;
constexpr double kFirstSigma_m_s = 2.0;  ///< of the velocity before anything is known of it

/// Position and velocity in the plane, before and after a scan's fix.
struct State {
  Vector4 predicted, filtered;
  Matrix4 predicted_covariance, filtered_covariance;
  Matrix4 transition = Matrix4::Identity();
  bool begins = true;  ///< nothing leads here from the state before
};

struct Measurement {
  Eigen::Vector2d p_m;
  Eigen::Matrix2d covariance;
};

Measurement measured(const PathPlace& place) {
  const double least = 1.0 / (kUnseenSigma_m * kUnseenSigma_m);
  const Eigen::Matrix2d covariance =
      (place.fix.information + least * Eigen::Matrix2d::Identity()).inverse();
  return {place.p_map_m + covariance * place.fix.pull, covariance};
}

State begun_at(const PathPlace& place) {
  State state;
  state.predicted << place.p_map_m, 0.0, 0.0;
  state.predicted_covariance.setZero();
  state.predicted_covariance.diagonal() << 1.0, 1.0, kFirstSigma_m_s * kFirstSigma_m_s,
      kFirstSigma_m_s * kFirstSigma_m_s;
  return state;
}

/// A constant velocity that an acceleration, the same over the step, changes.
State went_on(const State& before, double dt_s, double acceleration_m_s2) {
  State state;
  state.begins = false;
  state.transition.topRightCorner<2, 2>().diagonal().setConstant(dt_s);
  Eigen::Matrix<double, 4, 2> push;
  push << 0.5 * dt_s * dt_s * Eigen::Matrix2d::Identity(), dt_s * Eigen::Matrix2d::Identity();
  state.predicted = state.transition * before.filtered;
  state.predicted_covariance =
      state.transition * before.filtered_covariance * state.transition.transpose() +
      acceleration_m_s2 * acceleration_m_s2 * push * push.transpose();
  return state;
}

double squared_sigmas(const State& state, const Measurement& measurement) {
  const Eigen::Vector2d off = measurement.p_m - state.predicted.head<2>();
  const Eigen::Matrix2d spread =
      state.predicted_covariance.topLeftCorner<2, 2>() + measurement.covariance;
  return off.dot(spread.inverse() * off);
}

void take_in(const Measurement& measurement, State& state) {
  const Matrix4& before = state.predicted_covariance;
  const Eigen::Matrix2d spread = before.topLeftCorner<2, 2>() + measurement.covariance;
  const Eigen::Matrix<double, 4, 2> gain = before.leftCols<2>() * spread.inverse();
  state.filtered = state.predicted + gain * (measurement.p_m - state.predicted.head<2>());
  state.filtered_covariance = before - gain * before.topRows<2>();
}

std::vector<State> filter(std::span<const PathPlace> path, const SmoothConfig& config) {
  std::vector<State> states;
  states.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Measurement measurement = measured(path[i]);
    const double dt_s = i == 0 ? 0.0 : to_seconds(path[i].stamp - path[i - 1].stamp);
    State state = begun_at(path[i]);
    if (dt_s > 0.0 && dt_s <= kLongestStep_s) {
      const State next = went_on(states.back(), dt_s, config.acceleration_m_s2);
      if (squared_sigmas(next, measurement) <= config.max_sigmas * config.max_sigmas) state = next;
    }
    take_in(measurement, state);
    states.push_back(state);
  }
  return states;
}

}  // namespace

PositionFix certain_fix() {
  return {Eigen::Matrix2d::Identity() / (kCertainSigma_m * kCertainSigma_m),
          Eigen::Vector2d::Zero()};
}

PositionFix position_fix(const MatchResult& match, const Prediction& prediction) {
  if (match.verdict == Verdict::rejected) return {};
  const Eigen::Matrix2d covariance = match.evidence.covariance.topLeftCorner<2, 2>();
  const double prior = 1.0 / (prediction.sigma_xy_m * prediction.sigma_xy_m);
  if (covariance.determinant() <= 0.0 || !std::isfinite(prior)) return certain_fix();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance.inverse() -
                                                            prior * Eigen::Matrix2d::Identity());
  const Eigen::Vector2d seen = axes.eigenvalues().cwiseMax(0.0);
  const Eigen::Vector2d drawn =
      axes.eigenvectors().transpose() *
      (match.T_map_head.translation() - prediction.T_map_head.translation());
  const Eigen::Vector2d pull = (seen.array() > 0.0).select(prior * drawn, 0.0);
  return {axes.eigenvectors() * seen.asDiagonal() * axes.eigenvectors().transpose(),
          axes.eigenvectors() * pull};
}

std::vector<Eigen::Vector2d> smooth_path(std::span<const PathPlace> path,
                                         const SmoothConfig& config) {
  const std::vector<State> states = filter(path, config);
  std::vector<Eigen::Vector2d> smoothed(states.size());
  Vector4 after = Vector4::Zero();
  for (std::size_t i = states.size(); i-- > 0;) {
    const State& here = states[i];
    Vector4 best = here.filtered;
    if (i + 1 < states.size() && !states[i + 1].begins) {
      const State& next = states[i + 1];
      const Matrix4 gain = here.filtered_covariance * next.transition.transpose() *
                           next.predicted_covariance.inverse();
      best += gain * (after - next.predicted);
    }
    smoothed[i] = best.head<2>();
    after = best;
  }
  return smoothed;
}

}  // namespace lifeline::slam
