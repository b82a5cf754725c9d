#pragma once

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// What is asked of these two maps.
[[nodiscard]] const AcceptanceLimits& limits_for(const MapFeatures& a, const MapFeatures& b,
                                                 const MatchConfig& config);

/// The mirror image's score is of interest down to this share of the best place's: less of it makes
/// the lead no larger.
[[nodiscard]] double least_control_share(const AcceptanceLimits& limits);

/// Fills in margin, lead, verdict and reason from the candidates of `result`. In doubt the verdict
/// is wait: maps grow. With Method::spectra the paper's two criteria decide alone.
void judge(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config,
           MatchResult& result);

}  // namespace lifeline::matching
