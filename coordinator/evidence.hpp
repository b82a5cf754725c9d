#pragma once

#include "common/wire/messages.hpp"
#include "coordinator/matching/match_types.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline {

/// A match as it is published; the envelope is still to be filled.
[[nodiscard]] wire::MergeEvidence to_evidence(const merging::LayerPair& pair,
                                              const matching::MatchResult& result);

}  // namespace lifeline
