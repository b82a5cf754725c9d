#pragma once

#include <Eigen/Core>

#include "agents/slam/slam_types.hpp"

namespace lifeline::slam {

/// What a scan by itself tells of where it was taken, without the prediction it was matched from.
/// Axes of the frame that the position is given in.
struct PositionFix {
  /// In 1/m^2; along a direction in which nothing was seen it is zero.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  /// Information times (where the scan alone would lie - where it was placed), in 1/m: the
  /// prediction drew it away from there.
  Eigen::Vector2d pull = Eigen::Vector2d::Zero();
  /// Where the head was so long after the scan's stamp is what it tells, in the middle of its
  /// sweep:
  double after_stamp_s = 0.0;
  /// This far from where it was placed, by the velocity that its sweep was taken with.
  Eigen::Vector2d ahead_m = Eigen::Vector2d::Zero();
};

/// Takes the prediction's share out of a match's place and covariance. Frame: map. Nothing is known
/// where the match was rejected; one that states no covariance is taken as certain.
[[nodiscard]] PositionFix position_fix(const MatchResult& match, const Prediction& prediction);
/// Of a place that is to stay where it is.
[[nodiscard]] PositionFix certain_fix();

/// Position and velocity of a head that walks, in the plane: x, y (m), then their rates (m/s).
struct WalkState {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  [[nodiscard]] Eigen::Vector2d position_m() const { return mean.head<2>(); }
  /// Of the position so long after, at this velocity.
  [[nodiscard]] Eigen::Matrix2d position_covariance(double after_s) const;
};

/// Kalman filter of a constant velocity that an acceleration, the same over a step, changes. Where
/// a scan sees nothing along a direction, it goes on there at the speed known before, is less and
/// less sure of it, and learns from the next scan that does see how far it was off.
class WalkFilter {
 public:
  /// One standard deviation of the acceleration, along x and along y.
  explicit WalkFilter(double acceleration_m_s2) : acceleration_m_s2_(acceleration_m_s2) {}

  /// At a position known to `sigma_m`, with no velocity known but that it is about so large.
  [[nodiscard]] static WalkState begin(const Eigen::Vector2d& p_m, double sigma_m,
                                       double speed_sigma_m_s);
  /// What takes a state on by a time.
  [[nodiscard]] static Eigen::Matrix4d transition(double dt_s);
  /// After `dt_s`, as far as can be told. `unsure_s`, no less, is how long it may have been.
  [[nodiscard]] WalkState after(const WalkState& state, double dt_s, double unsure_s) const;
  /// A scan was placed at `p_m` and tells `fix`. Frame of the state.
  [[nodiscard]] static WalkState take_in(const WalkState& state, const Eigen::Vector2d& p_m,
                                         const PositionFix& fix);
  /// How far off the state's position that scan is, in standard deviations.
  [[nodiscard]] static double sigmas_off(const WalkState& state, const Eigen::Vector2d& p_m,
                                         const PositionFix& fix);

 private:
  double acceleration_m_s2_;
};

}  // namespace lifeline::slam
