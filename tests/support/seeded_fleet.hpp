#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/time.hpp"

namespace lifeline::test {

/// How one seed went.
struct SeedOutcome {
  std::vector<std::string> violations;
  Duration until_equal{};  ///< from the end of all faults
  std::size_t directives = 0;
  std::size_t starts = 0;  ///< of machines, the first ones included
};

/// Runs helmets and a coordinator (the real ones; layers and matches are scripted) on simulated
/// time over a simulated network: loss, delay, overtaking, doubled samples, partitions, crashes and
/// restarts with an empty disk, all from the seed. Then the faults end, and the fleet is given a
/// minute to become equal. A checker looks at every machine after every step.
[[nodiscard]] SeedOutcome run_seed(std::uint64_t seed);

}  // namespace lifeline::test
