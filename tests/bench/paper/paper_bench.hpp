#pragma once

#include <span>

#include "tests/bench/report.hpp"

namespace lifeline::bench {

/// `./lifeline bench paper`: the paper's four experiments in simulated buildings, against exact
/// truth. What follows the benchmark's name; answers the exit status.
[[nodiscard]] int run_paper_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
