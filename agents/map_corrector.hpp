#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "agents/slam/loop_closer.hpp"

namespace lifeline {

/// Closes loops on a thread of its own, beside the mapping thread, which never waits for it: a
/// correction takes as long as drawing the whole layer. Keyframes are never dropped; what waits
/// here the closer would hold anyway.
class MapCorrector {
 public:
  explicit MapCorrector(slam::LoopCloser closer);
  /// Ends the thread; keyframes that wait are not looked at any more.
  ~MapCorrector();

  void put(std::vector<slam::Keyframe> keyframes);
  /// The newest correction, if there is one that was not taken yet.
  [[nodiscard]] std::optional<slam::MapCorrection> take();
  /// Waits until all keyframes put before were looked at.
  void drain();

 private:
  void run(const std::stop_token& stop);

  slam::LoopCloser closer_;  ///< the thread's
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<slam::Keyframe> waiting_;
  bool busy_ = false;
  std::optional<slam::MapCorrection> newest_;
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline
