#include "agents/slam/walk_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace lifeline::slam {
namespace {

/// Of a direction in which a scan tells nothing: keeps its information invertible.
constexpr double kUnseenSigma_m = 30.0;
constexpr double kCertainSigma_m = 0.001;

using PositionOf = Eigen::Matrix<double, 2, 4>;

/// The state's position, so long after.
PositionOf position_after(double after_s) {
  PositionOf position;
  position << Eigen::Matrix2d::Identity(), after_s * Eigen::Matrix2d::Identity();
  return position;
}

/// What a scan tells beyond what the state does.
struct Innovation {
  Innovation(const WalkState& state, const Eigen::Vector2d& p_m, const PositionFix& fix)
      : position(position_after(fix.after_stamp_s)) {
    const double least = 1.0 / (kUnseenSigma_m * kUnseenSigma_m);
    const Eigen::Matrix2d own = (fix.information + least * Eigen::Matrix2d::Identity()).inverse();
    off_m = p_m + own * fix.pull + fix.ahead_m - position * state.mean;
    covariance = state.position_covariance(fix.after_stamp_s) + own;
  }
  PositionOf position;
  Eigen::Vector2d off_m;
  Eigen::Matrix2d covariance;
};

}  // namespace

PositionFix certain_fix() {
  PositionFix fix;
  fix.information = Eigen::Matrix2d::Identity() / (kCertainSigma_m * kCertainSigma_m);
  return fix;
}

PositionFix position_fix(const MatchResult& match, const Prediction& prediction) {
  if (match.verdict == Verdict::rejected) return {};
  const Eigen::Matrix2d covariance = match.evidence.covariance.topLeftCorner<2, 2>();
  if (covariance.determinant() <= 0.0 || prediction.sigma_xy_m <= 0.0) return certain_fix();
  const Eigen::Matrix2d prior = prediction.covariance_xy().inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance.inverse() - prior);
  const Eigen::Vector2d seen = axes.eigenvalues().cwiseMax(0.0);
  const Eigen::Vector2d drawn =
      axes.eigenvectors().transpose() * prior *
      (match.T_map_head.translation() - prediction.T_map_head.translation());
  const Eigen::Vector2d pull = (seen.array() > 0.0).select(drawn, 0.0);
  PositionFix fix;
  fix.information = axes.eigenvectors() * seen.asDiagonal() * axes.eigenvectors().transpose();
  fix.pull = axes.eigenvectors() * pull;
  return fix;
}

Eigen::Matrix2d WalkState::position_covariance(double after_s) const {
  const PositionOf position = position_after(after_s);
  return position * covariance * position.transpose();
}

WalkState WalkFilter::begin(const Eigen::Vector2d& p_m, double sigma_m, double speed_sigma_m_s) {
  WalkState state;
  state.mean << p_m, 0.0, 0.0;
  const double position = sigma_m * sigma_m, speed = speed_sigma_m_s * speed_sigma_m_s;
  state.covariance.diagonal() << position, position, speed, speed;
  return state;
}

Eigen::Matrix4d WalkFilter::transition(double dt_s) {
  Eigen::Matrix4d on = Eigen::Matrix4d::Identity();
  on.topRightCorner<2, 2>().diagonal().setConstant(dt_s);
  return on;
}

WalkState WalkFilter::after(const WalkState& state, double dt_s, double unsure_s) const {
  const Eigen::Matrix4d on = transition(dt_s);
  Eigen::Matrix<double, 4, 2> push;
  push << 0.5 * unsure_s * unsure_s * Eigen::Matrix2d::Identity(),
      unsure_s * Eigen::Matrix2d::Identity();
  WalkState after{on * state.mean,
                  on * state.covariance * on.transpose() +
                      acceleration_m_s2_ * acceleration_m_s2_ * push * push.transpose()};
  const Eigen::Vector2d maybe_more_m = (unsure_s - dt_s) * state.mean.tail<2>();
  after.covariance.topLeftCorner<2, 2>() += maybe_more_m * maybe_more_m.transpose();
  return after;
}

WalkState WalkFilter::take_in(const WalkState& state, const Eigen::Vector2d& p_m,
                              const PositionFix& fix) {
  const Innovation innovation(state, p_m, fix);
  const Eigen::Matrix<double, 4, 2> gain =
      state.covariance * innovation.position.transpose() * innovation.covariance.inverse();
  return {state.mean + gain * innovation.off_m,
          state.covariance - gain * innovation.position * state.covariance};
}

double WalkFilter::sigmas_off(const WalkState& state, const Eigen::Vector2d& p_m,
                              const PositionFix& fix) {
  const Innovation innovation(state, p_m, fix);
  return std::sqrt(innovation.off_m.dot(innovation.covariance.inverse() * innovation.off_m));
}

}  // namespace lifeline::slam
