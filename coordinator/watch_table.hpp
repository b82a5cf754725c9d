#pragma once

#include <string>

#include "common/sharing/roster.hpp"

namespace lifeline {

/// Who of the fleet was heard, a line each, as people read it in a terminal.
[[nodiscard]] std::string watch_table(const sharing::Roster& roster, SteadyTime now);

/// How many of those present hold one common map: "all 4 hold one map", "3 of 4 hold one map", or
/// that there is none.
[[nodiscard]] std::string agreement(const sharing::Roster& roster, SteadyTime now);

}  // namespace lifeline
