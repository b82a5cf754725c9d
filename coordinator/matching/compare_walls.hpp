#pragma once

#include <Eigen/Core>

#include "common/grid/pose2.hpp"
#include "coordinator/matching/map_features.hpp"

namespace lifeline::matching {

/// What becomes of one map's wall when it is laid on another map. Lengths in metres.
struct WallFigures {
  double agreeing_m = 0.0;     ///< on wall that faces the same way
  double conflicting_m = 0.0;  ///< in space that the other map saw free, well away from its walls
  double missed_m = 0.0;       ///< in area that the other map knows, but neither of the above
  double unseen_m = 0.0;       ///< where the other map knows nothing
  /// Sum of length * n * n^T over the agreeing wall, normals in the other map's frame.
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  ///< sum of length * point, own local frame

  WallFigures& operator+=(const WallFigures& other);
  /// Wall that lies in what both maps have seen.
  [[nodiscard]] double judged_m() const { return agreeing_m + conflicting_m + missed_m; }
};

/// What counts as agreeing.
struct WallGate {
  float distance_m = 0.1F;  ///< from the other wall's line
  float min_cosine = 0.8F;  ///< between the normals
};

/// Counts as agreement in all figures that are reported.
inline constexpr WallGate kFineGate{0.10F, 0.88F};

/// Lays `walls` of map b on map a by T_a_b (between the local frames).
[[nodiscard]] WallFigures compare_walls(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                                        const MapFeatures& a, const WallGate& gate);

/// The wall of b that lies in a's clear space, as connected pieces (gaps up to about 0.3 m): the
/// length of the longest, in metres.
[[nodiscard]] double longest_conflict_m(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                                        const MapFeatures& a);

/// How much of the wall of b that lies in a's clear space, in metres, is only displaced: a has wall
/// that faces the same way within 1 m across itself. A bent map moves its walls a little; where the
/// place is wrong, a has no such wall for most of them.
[[nodiscard]] double displaced_conflict_m(const std::vector<WallPoint>& walls, const Pose2& T_a_b,
                                          const MapFeatures& a);

}  // namespace lifeline::matching
