#pragma once

#include <Eigen/Core>

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// A metre of wall in the other map's free space speaks against a match more than a metre of
/// agreeing wall speaks for it: right matches have next to none of it (docs/decisions/0301).
inline constexpr double kConflictWeight = 4.0;

/// A candidate with all its figures, and where its agreement lies.
struct MeasuredCandidate {
  MatchCandidate candidate;
  Eigen::Vector2d overlap_centre_b_m{0.0, 0.0};  ///< b's map frame
};

/// Lays b on a by `T_a_b_local` (between the local frames) and takes all figures: walls both ways,
/// Eq. 12 and 13. The candidate's T_a_b is between the map frames.
[[nodiscard]] MeasuredCandidate measure_candidate(const MapFeatures& a, const MapFeatures& b,
                                                  const Pose2& T_a_b_local,
                                                  const MatchConfig& config);

/// Between the map frames, given between the local frames.
[[nodiscard]] Pose2 to_map_frames(const MapFeatures& a, const MapFeatures& b,
                                  const Pose2& T_a_b_local);
/// The other way round.
[[nodiscard]] Pose2 to_local_frames(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b);

}  // namespace lifeline::matching
