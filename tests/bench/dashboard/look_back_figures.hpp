#pragma once

namespace lifeline::bench {

/// What it takes to look back at ten minutes of eight helmets, recorded just now.
struct LookBackFigures {
  double way_s = 0.0;       ///< from the beginning to the end, as fast as it goes
  double rest_share = 0.0;  ///< of a core, while it stands still
  double play_share = 0.0;  ///< of a core, while it plays as fast as it was
  double memory_mb = 0.0;   ///< that the process grew by
};

/// NaN where it cannot be recorded.
[[nodiscard]] LookBackFigures look_back_figures();

}  // namespace lifeline::bench
