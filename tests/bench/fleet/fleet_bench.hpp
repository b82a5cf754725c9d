#pragma once

#include <span>

namespace lifeline::bench {

/// `fleet [--out FILE] [--seeds N] [--first N]`: the deterministic fleet (docs/testing.md), many
/// seeds long. Prints every violation with its seed. Exit status as of finish(), 2 for wrong use.
[[nodiscard]] int run_fleet_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
