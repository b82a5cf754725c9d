#pragma once

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// The default way to T_G: rotations from the oriented spectra, translations from the correlation
/// of the walls, robust refinement below a cell. Returns distinct hypotheses with their figures,
/// best first, and the best one's covariance and overlap; the verdict is left to judge().
[[nodiscard]] MatchResult match_oriented(const MapFeatures& a, const MapFeatures& b,
                                         const MatchConfig& config);

/// The score of the best place at which b lies on a: of b's mirror image, what chance gives. Only
/// scores of `least` and more are exact; places that are far from it are not looked at closely, and
/// the answer is 0 where there are no others.
[[nodiscard]] double best_score(const MapFeatures& a, const MapFeatures& b,
                                const MatchConfig& config, double least);

}  // namespace lifeline::matching
