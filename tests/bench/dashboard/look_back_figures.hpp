#pragma once

#include <chrono>

namespace lifeline::bench {

/// What it takes to look back at some minutes of eight helmets, recorded just now.
struct LookBackFigures {
  double way_s = 0.0;       ///< from the beginning to the end, as fast as it goes
  double rest_share = 0.0;  ///< of a core, while it stands still
  double play_share = 0.0;  ///< of a core, while it plays as fast as it was
  double memory_mb = 0.0;   ///< that the process grew by
};

/// `recorded`: how much of the mission, two minutes or more. NaN where it cannot be recorded.
[[nodiscard]] LookBackFigures look_back_figures(std::chrono::minutes recorded);

}  // namespace lifeline::bench
