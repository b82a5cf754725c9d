#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/merge/merge_pairs.hpp"

namespace lifeline::bench {

/// What became of maps of different buildings that were held against each other.
struct CrossedOutcome {
  std::size_t pairs = 0;
  std::vector<std::string> accepted;  ///< each of them wrong: which maps, and the reason
};

/// Holds `count` maps of `pairs` against maps of other buildings, drawn by `seed`: the recorded
/// pairs of two buildings are few, their maps give tens of thousands.
[[nodiscard]] CrossedOutcome match_crossed(const std::vector<MergePair>& pairs, std::size_t count,
                                           std::uint64_t seed, const matching::MatchConfig& config);

}  // namespace lifeline::bench
