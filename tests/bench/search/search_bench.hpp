#pragma once

#include <span>

namespace lifeline::bench {

/// `lifeline-bench search`: what the search help costs on a made-up building of about 1,000 tiles
/// with 8 and with 50 helmets.
[[nodiscard]] int run_search_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
