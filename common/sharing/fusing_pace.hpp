#pragma once

#include <algorithm>

#include "common/base/time.hpp"

namespace lifeline::sharing {

/// When a fused map is brought up to date: always while that takes next to nothing. In a large team
/// on a small machine rarely enough that it takes a quarter of the time at most, and a tile that
/// several members changed meanwhile is fused once (docs/decisions/0118). A state machine on
/// somebody else's clock.
class FusingPace {
 public:
  [[nodiscard]] bool is_due(SteadyTime now) const { return now >= due_; }
  void took(SteadyTime begun, SteadyTime ended) {
    const Duration work = ended - begun;
    due_ = work < kNextToNothing ? ended : ended + std::min(kRestsAfterWork * work, kLongestRest);
  }

 private:
  static constexpr Duration kNextToNothing = std::chrono::milliseconds(10);
  static constexpr int kRestsAfterWork = 3;
  static constexpr Duration kLongestRest = std::chrono::seconds(2);
  SteadyTime due_{};
};

}  // namespace lifeline::sharing
