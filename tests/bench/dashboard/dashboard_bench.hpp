#pragma once

#include <span>

namespace lifeline::bench {

/// `bench dashboard`: the page in headless Chromium under the load of 50 helmets, 5,000 tiles and
/// ten frames a second, from a synthetic feeder: first picture, frames a second, the page's memory,
/// the server's share of a core.
[[nodiscard]] int run_dashboard_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
