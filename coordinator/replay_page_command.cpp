#include "coordinator/replay_page_command.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>

#include <fmt/format.h>

#include "common/base/stop_signal.hpp"

namespace lifeline {
namespace {

using std::chrono::steady_clock;
// How long a person at the page waits for an answer.
constexpr Duration kTurn = std::chrono::milliseconds(20);

}  // namespace

Result<std::unique_ptr<ReplayPage>> ReplayPage::open(std::unique_ptr<Replay> replay,
                                                     const ReplayCommandOptions& options,
                                                     std::optional<double> speed) {
  const auto listen = dashboard::parse_listen_address(options.dashboard.value_or("off"));
  if (!listen) return forward_error(listen);
  if (!*listen) return fail(ErrorCode::wrong_use, "--dashboard off: no page is asked for");
  const auto span = replay->span();
  if (!span) return forward_error(span);
  std::unique_ptr<ReplayPage> made(new ReplayPage(std::move(replay), options.bag));
  constexpr double kAreaUnknown_m2 = 0.0;  // a recording does not say how large the site was
  auto page =
      dashboard::Dashboard::open(**listen, made->replay_->coordinator(),
                                 made->replay_->facts().geometry.cell_size_m, kAreaUnknown_m2);
  if (!page) return forward_error(page);
  made->page_ = *std::move(page);
  made->timeline_.begin = span->first;
  made->timeline_.length = span->last - span->first;
  made->timeline_.speed = speed.value_or(0.0);
  fmt::print(stderr, "{}\n", dashboard::describe(made->page_->server()));
  return made;
}

void ReplayPage::anchor() {
  anchored_ = steady_clock::now();
  anchor_ = replay_->elapsed();
}

void ReplayPage::show(bool is_seeking) {
  timeline_.at = std::min(replay_->elapsed(), timeline_.length);
  timeline_.is_seeking = is_seeking;
  page_->show(timeline_);
  page_->step(replay_->steady_now());
}

Result<void> ReplayPage::run(const std::function<void(const Replay&)>& at_end) {
  bool is_told = false;
  anchor();
  while (!stop_requested()) {
    if (const auto steer = page_->take_steer()) {
      if (auto followed = follow(*steer); !followed) return followed;
    }
    if (auto played = play(); !played) return played;
    if (is_at_end_ && !std::exchange(is_told, true)) at_end(*replay_);
    show(false);
  }
  return {};
}

// What is due within a turn. A person who waits is not kept waiting by a recording that is not.
Result<void> ReplayPage::play() {
  const SteadyTime turn_ends = steady_clock::now() + kTurn;
  while (!timeline_.is_paused && !is_at_end_) {
    const SteadyTime now = steady_clock::now();
    if (now >= turn_ends) return {};
    const bool is_due = timeline_.speed <= 0.0 || to_seconds(replay_->elapsed() - anchor_) <=
                                                      to_seconds(now - anchored_) * timeline_.speed;
    if (!is_due) break;
    const auto more = replay_->step();
    if (!more) return forward_error(more);
    is_at_end_ = !*more;
    if (is_at_end_) page_->refresh();
  }
  std::this_thread::sleep_until(turn_ends);
  return {};
}

Result<void> ReplayPage::follow(const dashboard::Steer& steer) {
  timeline_.is_paused = steer.is_paused;
  timeline_.speed = steer.speed;
  if (steer.to) {
    if (auto gone = go_to(std::clamp(*steer.to, Duration{0}, timeline_.length)); !gone) return gone;
  }
  anchor();
  return {};
}

Result<void> ReplayPage::go_to(Duration to) {
  if (to < replay_->elapsed()) {
    auto again = Replay::open(bag_);
    if (!again) return forward_error(again);
    page_->look_at((*again)->coordinator());
    replay_ = *std::move(again);
    is_at_end_ = false;
  }
  SteadyTime show_due = steady_clock::now();
  while (!is_at_end_ && replay_->elapsed() < to && !stop_requested()) {
    const auto more = replay_->step();
    if (!more) return forward_error(more);
    is_at_end_ = !*more;
    if (steady_clock::now() < show_due) continue;
    show(true);
    show_due = steady_clock::now() + 5 * kTurn;
  }
  page_->refresh();
  return {};
}

}  // namespace lifeline
