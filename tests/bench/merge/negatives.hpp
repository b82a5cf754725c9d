#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "coordinator/matching/match_types.hpp"

namespace lifeline::bench {

/// What was asked of the matcher, and how often.
struct NegativeKind {
  std::string name;
  std::size_t pairs = 0;
  std::size_t accepted_wrong = 0;
  std::size_t accepted_right = 0;  ///< where the maps do share a place and it was found
};

/// A wrong merge: enough to look at it again.
struct FalseAccept {
  std::string kind, a, b, reason;
};

struct NegativesOutcome {
  std::vector<NegativeKind> kinds;
  std::vector<FalseAccept> wrong;
};

/// Which pairs are made. The same numbers give the same pairs.
struct NegativesChoice {
  std::size_t pairs = 10'000;
  std::filesystem::path plans =
      {};  ///< folder of HouseExpo plans; without it, generated offices alone
  std::uint64_t seed = 20240;
  bool pictures = false;  ///< the cells of Eq. 6, as a saved map has them, instead of TSD layers
};

/// Matches `choice.pairs` pairs of simulated maps that tempt to a wrong merge: other plans, the
/// mirror image of a plan, parts of one plan far from each other, symmetric halls, repeated rooms.
/// Maps of one floor count as wrong only where they are merged 0.5 m or 2 deg or more off the
/// truth. `tell` hears after each floor how many pairs were matched and how many of them merged
/// wrongly.
[[nodiscard]] NegativesOutcome run_negatives(
    const NegativesChoice& choice, const matching::MatchConfig& config,
    const std::function<void(std::size_t, std::size_t)>& tell = {});

}  // namespace lifeline::bench
