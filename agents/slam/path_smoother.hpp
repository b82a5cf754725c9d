#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/motion_model.hpp"
#include "agents/slam/slam_types.hpp"
#include "common/base/time.hpp"

namespace lifeline::slam {

/// What a scan by itself tells of where it was taken, without the prediction it was matched from.
/// Axes of the frame that the position is given in.
struct PositionFix {
  /// In 1/m^2; along a direction in which nothing was seen it is zero.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  /// Information times (where the scan alone would lie - where it was placed), in 1/m: the
  /// prediction drew it away from there.
  Eigen::Vector2d pull = Eigen::Vector2d::Zero();
};

/// Takes the prediction's share out of a match's place and covariance. Frame: map. Nothing is known
/// where the match was rejected; one that states no covariance is taken as certain.
[[nodiscard]] PositionFix position_fix(const MatchResult& match, const Prediction& prediction);
/// Of a place that is to stay where it is.
[[nodiscard]] PositionFix certain_fix();

/// One place of a path: where the scan was placed when it came, and what it told.
struct PathPlace {
  Timestamp stamp{};
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  PositionFix fix;
};

struct SmoothConfig {
  double acceleration_m_s2 = 1.0;  ///< of a head that walks, one standard deviation
  double max_sigmas = 4.0;         ///< a place further off its neighbours is a jump, not a motion
};

/// Where the head was, by the scans before and after: a walker's speed changes gradually, so where
/// a scan saw nothing along a corridor, those that see again tell how far the helmet had come
/// (Kalman filter over position and velocity, then backwards after Rauch, Tung and Striebel 1965).
/// Nothing is smoothed across a jump or a pause. Same length and order as `path`; O(n).
[[nodiscard]] std::vector<Eigen::Vector2d> smooth_path(std::span<const PathPlace> path,
                                                       const SmoothConfig& config = {});

}  // namespace lifeline::slam
