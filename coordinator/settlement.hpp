#pragma once

#include <cstddef>
#include <string_view>

#include "coordinator/coordinator.hpp"

namespace lifeline {

/// How far a fleet has come, once its helmets map no more.
enum class Settlement {
  working,  ///< somebody still maps, sends or is being matched
  apart,    ///< all is said and received, but the helmets are not all in one group
  shared,   ///< all helmets and the coordinator hold the same common map, to the bit
};

/// "working", "apart", "shared".
[[nodiscard]] std::string_view to_string(Settlement settlement);

/// Judges by the newest statuses alone. `helmets` is how many are expected.
[[nodiscard]] Settlement settlement(const Coordinator& coordinator, std::size_t helmets);

}  // namespace lifeline
