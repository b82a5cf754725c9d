#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "common/base/result.hpp"
#include "coordinator/dashboard/recording_screen.hpp"
#include "coordinator/recording/replay.hpp"

namespace lifeline {

/// Plays a recording into a page's feed, and follows what people ask for there: stop, another
/// speed, another time. Goes far by a shortcut (Replay::take_shortcut), and back from the beginning
/// anew: the same code, the same picture. One owner, not thread-safe.
class RecordingPlayer {
 public:
  /// The same recording from its beginning.
  using Open = std::function<Result<std::unique_ptr<Replay>>()>;

  /// `feed` must outlive it. `begun`: how it is played at first. Errors as of `open` and
  /// Replay::span().
  [[nodiscard]] static Result<std::unique_ptr<RecordingPlayer>> open(
      Open open, dashboard::Feed& feed, const dashboard::Timeline& begun);

  /// What is due within 20 ms, and no longer than those; waits where there is less to do. Errors as
  /// of Replay::step().
  [[nodiscard]] Result<void> turn();

  /// All that was recorded has been played.
  [[nodiscard]] bool is_at_end() const { return is_at_end_; }
  [[nodiscard]] const Replay& replay() const { return *replay_; }
  [[nodiscard]] const dashboard::Timeline& timeline() const { return timeline_; }

 private:
  RecordingPlayer(Open open, std::unique_ptr<Replay> replay, dashboard::Feed& feed,
                  const dashboard::Timeline& begun);
  [[nodiscard]] Result<void> follow(const dashboard::Steer& steer);
  [[nodiscard]] Result<void> play(SteadyTime turn_ends);
  [[nodiscard]] Result<void> measure();
  [[nodiscard]] bool is_due(SteadyTime now) const;
  /// A step, or a piece of a shortcut; false at the end.
  [[nodiscard]] Result<bool> go_on();
  void anchor();
  void show();

  Open open_;
  std::unique_ptr<Replay> replay_;
  dashboard::RecordingScreen screen_;  ///< after replay_, whose coordinator it shows
  dashboard::Timeline timeline_;
  std::optional<Duration> target_;  ///< a time that was asked for and is not reached yet
  SteadyTime anchored_{};           ///< then, by the machine's clock, ...
  Duration anchor_{};               ///< ... the recording was here
  SteadyTime picture_due_{};
  bool is_at_end_ = false;
};

}  // namespace lifeline
