#include "common/sharing/flood_watch.hpp"

#include "common/base/log.hpp"

namespace lifeline::sharing {

bool FloodWatch::note(std::string_view topic, const std::string& sender_id, SteadyTime now) {
  if (!senders_.contains(sender_id) && senders_.size() >= kMaxSenders) return false;
  Sender& sender = senders_[sender_id];
  if (now - sender.since >= kInterval) {
    const double most = kFloodPerSecond * to_seconds(kInterval);
    sender = {now, 0, static_cast<double>(sender.samples) > most};
  }
  ++sender.samples;
  const bool too_many =
      static_cast<double>(sender.samples) > kFloodPerSecond * to_seconds(kInterval);
  if (!too_many || sender.floods) return false;
  sender.floods = true;
  ++floods_;
  spdlog::warn(
      "{} floods {}: more than {:.0f} samples a second; restart it, or look for what it repeats",
      sender_id, topic, kFloodPerSecond);
  return true;
}

}  // namespace lifeline::sharing
