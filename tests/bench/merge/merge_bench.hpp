#pragma once

#include <span>

namespace lifeline::bench {

/// `merge [--out FILE] [--pairs FOLDER | --negatives [COUNT] [--seed N] [--plans FOLDER]]`: how
/// often two maps are merged rightly, wrongly or not at all, by the default path and by the
/// paper's; see docs/benchmarks.md. Exit status as of finish(), 2 for wrong use.
[[nodiscard]] int run_merge_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
