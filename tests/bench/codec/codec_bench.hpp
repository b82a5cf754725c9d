#pragma once

#include <span>

namespace lifeline::bench {

/// `codec [--out FILE] [--data DIR] [--only TEXT] [--config FILE]`: what a known square metre costs
/// on the air, by our tiles and by general compressors; see docs/benchmarks.md. Exit status as of
/// finish(), 2 for wrong use.
[[nodiscard]] int run_codec_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
