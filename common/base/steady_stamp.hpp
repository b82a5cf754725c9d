#pragma once

#include "common/base/time.hpp"

namespace lifeline {

/// A steady time as a stamp on this process's wall clock as that stood when this was first asked:
/// what several live sensors stamp their samples with, so that they fit together whatever happens
/// to the wall clock later.
[[nodiscard]] inline Timestamp stamp_of(SteadyTime time) {
  static const Duration wall_minus_steady = std::chrono::system_clock::now().time_since_epoch() -
                                            std::chrono::steady_clock::now().time_since_epoch();
  return Timestamp(time.time_since_epoch() + wall_minus_steady);
}

}  // namespace lifeline
