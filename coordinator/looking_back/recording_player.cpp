#include "coordinator/looking_back/recording_player.hpp"

#include <algorithm>
#include <thread>

namespace lifeline {
namespace {

using std::chrono::steady_clock;
// How long a person at the page waits for an answer.
constexpr Duration kTurn = std::chrono::milliseconds(20);
// On the way to another time the picture would cost more than the way.
constexpr Duration kPictureInterval = std::chrono::seconds(1);
// What is played whole before a time that was asked for, so that it looks as if it had been played
// to: who was just heard, what waits.
constexpr Duration kPlayedWhole = std::chrono::seconds(5);

}  // namespace

Result<std::unique_ptr<RecordingPlayer>> RecordingPlayer::open(Open open, dashboard::Feed& feed,
                                                               const dashboard::Timeline& begun) {
  auto replay = open();
  if (!replay) return forward_error(replay);
  std::unique_ptr<RecordingPlayer> player(
      new RecordingPlayer(std::move(open), *std::move(replay), feed, begun));
  if (auto measured = player->measure(); !measured) return forward_error(measured);
  player->anchor();
  return player;
}

RecordingPlayer::RecordingPlayer(Open open, std::unique_ptr<Replay> replay, dashboard::Feed& feed,
                                 const dashboard::Timeline& begun)
    : open_(std::move(open)),
      replay_(std::move(replay)),
      screen_(replay_->coordinator(), feed),
      timeline_(begun) {}

Result<void> RecordingPlayer::measure() {
  const auto span = replay_->span();
  if (!span) return forward_error(span);
  timeline_.begin = span->first;
  timeline_.length = span->last - span->first;
  return {};
}

void RecordingPlayer::anchor() {
  anchored_ = steady_clock::now();
  anchor_ = replay_->elapsed();
}

Result<void> RecordingPlayer::turn() {
  if (timeline_.is_mission_live) {
    is_at_end_ = false;  // more may have come
    if (auto measured = measure(); !measured) return measured;
  }
  if (const auto steer = screen_.take_steer()) {
    if (auto followed = follow(*steer); !followed) return followed;
  }
  const SteadyTime turn_ends = steady_clock::now() + kTurn;
  if (auto played = play(turn_ends); !played) return played;
  show();
  if (!is_due(steady_clock::now())) std::this_thread::sleep_until(turn_ends);
  return {};
}

Result<void> RecordingPlayer::follow(const dashboard::Steer& steer) {
  timeline_.is_paused = steer.is_paused;
  timeline_.speed = steer.speed;
  anchor();
  if (!steer.to) return {};
  target_ = std::clamp(*steer.to, Duration{0}, timeline_.length);
  if (*target_ >= replay_->read_so_far()) return {};
  auto again = open_();
  if (!again) return forward_error(again);
  screen_.look_at((*again)->coordinator());
  replay_ = *std::move(again);
  is_at_end_ = false;
  return {};
}

bool RecordingPlayer::is_due(SteadyTime now) const {
  if (is_at_end_) return false;
  if (target_) return replay_->elapsed() < *target_;
  if (timeline_.is_paused) return false;
  return timeline_.speed <= 0.0 ||
         to_seconds(replay_->elapsed() - anchor_) <= to_seconds(now - anchored_) * timeline_.speed;
}

// A person who waits is not kept waiting by a recording that is not.
Result<void> RecordingPlayer::play(SteadyTime turn_ends) {
  for (SteadyTime now = steady_clock::now(); now < turn_ends && is_due(now);
       now = steady_clock::now()) {
    const auto more = go_on();
    if (!more) return forward_error(more);
    is_at_end_ = !*more;
    if (is_at_end_ && !timeline_.is_mission_live) screen_.refresh();
  }
  if (target_ && (is_at_end_ || replay_->elapsed() >= *target_)) {
    target_.reset();
    anchor();
    screen_.refresh();
  }
  return {};
}

Result<bool> RecordingPlayer::go_on() {
  if (replay_->is_on_shortcut() || (target_ && *target_ > replay_->elapsed() + 2 * kPlayedWhole)) {
    const Duration to = target_.value_or(replay_->read_so_far()) - kPlayedWhole;
    auto more = replay_->take_shortcut(replay_->first() + to);
    if (!more) return more;
    return true;
  }
  return replay_->step();
}

void RecordingPlayer::show() {
  timeline_.at = std::min(replay_->read_so_far(), timeline_.length);
  timeline_.is_seeking = target_.has_value();
  screen_.show(timeline_);
  const SteadyTime now = steady_clock::now();
  if (target_ && now < picture_due_) return;
  picture_due_ = now + kPictureInterval;
  screen_.step(replay_->steady_now());
}

}  // namespace lifeline
