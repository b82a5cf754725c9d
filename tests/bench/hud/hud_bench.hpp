#pragma once

#include <span>

namespace lifeline::bench {

/// `hud [--out FILE] [--seconds N] [--display]`: what the HUD costs while its wearer walks through
/// a large building. Exit status as of finish(), 2 for wrong use.
[[nodiscard]] int run_hud_bench(std::span<const char* const> arguments);

}  // namespace lifeline::bench
