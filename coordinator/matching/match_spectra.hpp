#pragma once

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// The paper's way to T_G (section 3.3): rotations at the local maxima of the Hough spectra's
/// circular correlation (each also with half a turn added, which a Hough spectrum cannot tell),
/// translations at the maxima of the x and y spectra's correlations, ranked by Eq. 13 among those
/// that reach s_0 of Eq. 12. Candidates and their figures, best first; the verdict is left to
/// judge().
[[nodiscard]] MatchResult match_spectra(const MapFeatures& a, const MapFeatures& b,
                                        const MatchConfig& config);

}  // namespace lifeline::matching
