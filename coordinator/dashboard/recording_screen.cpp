#include "coordinator/dashboard/recording_screen.hpp"

namespace lifeline::dashboard {

RecordingScreen::RecordingScreen(Coordinator& coordinator, Feed& feed)
    : feed_(feed), observer_(std::in_place, coordinator, feed) {}

std::optional<Steer> RecordingScreen::take_steer() {
  for (const auto& order : feed_.take_orders()) {
    const auto done = follow(order.request);
    feed_.put(Outcome{order.client, order.request.request_id, done ? "" : done.error().text});
  }
  return std::exchange(steer_, std::nullopt);
}

Result<void> RecordingScreen::follow(const ClientRequest& request) {
  const auto* order = std::get_if<Steer>(&request.content);
  if (order == nullptr)
    return fail(ErrorCode::wrong_use, "this is a recording: what is done is done");
  // Wishes that come faster than they are followed: the last place is the one that counts.
  const auto to = steer_ && !order->to ? steer_->to : order->to;
  steer_ = Steer{order->is_paused, order->speed, to};
  return {};
}

void RecordingScreen::show(const Timeline& timeline) {
  // Often enough for a slider to run; a page that hears nothing for long joins anew.
  constexpr Duration kInterval = std::chrono::milliseconds(200);
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now < beat_due_) return;
  beat_due_ = now + kInterval;
  feed_.put(Section::timeline, timeline_frame(timeline, ++beats_));
  feed_.flush();
}

void RecordingScreen::look_at(Coordinator& coordinator) {
  observer_->take_back();
  observer_.emplace(coordinator, feed_);
}

}  // namespace lifeline::dashboard
