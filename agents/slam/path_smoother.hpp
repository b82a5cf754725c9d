#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/walk_filter.hpp"
#include "common/base/time.hpp"

namespace lifeline::slam {

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
