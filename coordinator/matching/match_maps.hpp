#pragma once

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// Looks for T_G between two maps and judges it: section 3.3 of the paper, or what replaces it
/// (docs/decisions/0301). A pure function of its arguments but for match_ms; swapping the maps
/// gives the inverse transforms. Safe to call from several threads on the same features. Maps of
/// different cell sizes are rejected with that reason.
[[nodiscard]] MatchResult match_maps(const MapFeatures& a, const MapFeatures& b,
                                     const MatchConfig& config);

}  // namespace lifeline::matching
