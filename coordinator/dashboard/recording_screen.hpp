#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

#include "coordinator/coordinator.hpp"
#include "coordinator/dashboard/feed.hpp"
#include "coordinator/dashboard/observer.hpp"
#include "coordinator/dashboard/timeline.hpp"

namespace lifeline::dashboard {

/// What a recording is shown on: tells a feed what the coordinator that plays it sees, and hears
/// from it where people want to go. Nothing else is ordered there. In the thread that plays.
class RecordingScreen {
 public:
  /// Before the coordinator's first step. Both must outlive this.
  RecordingScreen(Coordinator& coordinator, Feed& feed);

  /// What somebody wants, the newest wish; nothing where nobody said anything since.
  [[nodiscard]] std::optional<Steer> take_steer();
  /// Where in the recording it is; told a few times a second.
  void show(const Timeline& timeline);
  /// After steps of the coordinator: the picture.
  void step(SteadyTime now) { observer_->step(now); }
  /// Tells everything at the next step, whatever was told when.
  void refresh() { observer_->refresh(); }
  /// From now on another coordinator, before its first step; the one of before must still be there.
  void look_at(Coordinator& coordinator);

 private:
  [[nodiscard]] Result<void> follow(const ClientRequest& request);

  Feed& feed_;
  std::optional<Observer> observer_;
  std::optional<Steer> steer_;
  std::uint32_t beats_ = 0;
  SteadyTime beat_due_{};
};

}  // namespace lifeline::dashboard
