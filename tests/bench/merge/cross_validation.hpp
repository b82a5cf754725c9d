#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "coordinator/matching/match_types.hpp"
#include "tests/bench/merge/merge_pairs.hpp"

namespace lifeline::bench {

/// What limits that never saw a building do on that building.
struct Fold {
  std::string building;               ///< left out
  matching::AcceptanceLimits limits;  ///< learnt on the others
  std::size_t pairs = 0;              ///< in which the building takes part
  std::size_t can_merge = 0;          ///< of these, pairs whose best candidate is right
  std::size_t right = 0;              ///< merged rightly
  std::size_t wrong = 0;              ///< merged wrongly
};

/// Limits that let nearly everything through, so that judge_pair() gathers all evidence, the mirror
/// image's score included.
[[nodiscard]] matching::AcceptanceLimits loose_limits();

/// Leaves out one building after the other. Limits are learnt on the pairs in which it takes no
/// part: of a grid of limits, those that merge nothing wrongly there; of these the ones with the
/// most right merges; of those, the strictest. They then judge the pairs in which it does.
/// `judged` has to come from a match with loose_limits(). Pairs of drifted maps are left out.
[[nodiscard]] std::vector<Fold> cross_validate(const std::vector<JudgedPair>& judged);

}  // namespace lifeline::bench
