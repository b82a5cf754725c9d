#pragma once

#include <span>

namespace lifeline::bench {

/// `radio [--out FILE] [--only TEXT] [--helmets N] [--walk SECONDS] [--qos FILE] [--fine]`: real
/// helmets and a real coordinator, each in a network namespace, over links that lose and part; see
/// docs/benchmarks.md. Needs root, iproute2 and nftables. Exit status as of finish(), 2 for wrong
/// use.
[[nodiscard]] int run_radio_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
