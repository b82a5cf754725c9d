#include "coordinator/evidence.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/wire/limits.hpp"

namespace lifeline {
namespace {

wire::Verdict to_wire(matching::Verdict verdict) {
  switch (verdict) {
    case matching::Verdict::accepted:
      return wire::Verdict::accepted;
    case matching::Verdict::wait:
      return wire::Verdict::wait;
    case matching::Verdict::rejected:
      break;
  }
  return wire::Verdict::rejected;
}

}  // namespace

wire::MergeEvidence to_evidence(const merging::LayerPair& pair,
                                const matching::MatchResult& result) {
  wire::MergeEvidence evidence;
  evidence.a = sharing::to_layer_name(pair.a);
  evidence.b = sharing::to_layer_name(pair.b);
  evidence.verdict = to_wire(result.verdict);
  evidence.reason = result.reason.substr(0, wire::kMaxReason);
  evidence.margin = result.margin;
  evidence.match_ms = result.match_ms;
  const std::size_t count = std::min(result.candidates.size(), wire::kMaxCandidates);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& candidate = result.candidates[i];
    evidence.candidates.push_back({candidate.T_a_b, candidate.s_overlapping,
                                   candidate.acceptance_index, candidate.wall_agreement,
                                   candidate.conflict, candidate.score});
  }
  return evidence;
}

}  // namespace lifeline
