#pragma once

#include <chrono>

#include "common/base/time.hpp"

namespace lifeline::slam {

/// What the stages of one step took. A stage that did not run took no time.
struct StageTimes {
  Duration predict{};     ///< de-skewing, surfaces, prediction
  Duration match{};       ///< local alignment and its judgement; GICP where that failed
  Duration search{};      ///< correlative search, and the alignment of what it found
  Duration push{};        ///< of the scan, or of older ones settled by it
  Duration relocalise{};  ///< while lost
};

/// Adds the time it lives to a stage; costs a comparison where nobody asks.
class StageTimer {
 public:
  explicit StageTimer(Duration* stage) : stage_(stage) {
    if (stage_ != nullptr) started_ = std::chrono::steady_clock::now();
  }
  ~StageTimer() {
    if (stage_ != nullptr) *stage_ += std::chrono::steady_clock::now() - started_;
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Duration* stage_;
  std::chrono::steady_clock::time_point started_{};
};

}  // namespace lifeline::slam
