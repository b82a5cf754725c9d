#pragma once

#include <span>

namespace lifeline::bench {

/// `bench slam`: one helmet's accuracy, speed and memory on recorded logs and simulated walks. See
/// docs/benchmarks.md.
[[nodiscard]] int run_slam_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
