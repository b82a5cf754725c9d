#pragma once

#include <span>

namespace lifeline::bench {

/// `mission [--out FILE] [--only TEXT] [--walk SECONDS] [--many N]`: the real programs on this
/// machine's loopback interface: how soon a scan is in everybody's common map, and a large team;
/// see docs/benchmarks.md. Exit status as of finish(), 2 for wrong use.
[[nodiscard]] int run_mission_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
