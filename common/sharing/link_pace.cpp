#include "common/sharing/link_pace.hpp"

#include <algorithm>

namespace lifeline::sharing {
namespace {

constexpr Duration kLookInterval = std::chrono::seconds(1);
// A tile for eight receivers keeps a link of 250 kbit/s busy for a tenth of a second.
constexpr Duration kUsual = std::chrono::milliseconds(200);
// So much beyond it, and we slow down by kMostSlower.
constexpr Duration kMuchBeyond = std::chrono::milliseconds(500);
constexpr double kMostSlower = 0.6;
// Status and poses need as much for each receiver, of eight at least; what is late then is not
// ours.
constexpr double kLeastEach_bit_s = 12'000;
constexpr std::size_t kFewReceivers = 8;
// Others tell what they saw up to a second ago of what had queued before that.
constexpr Duration kSettling = std::chrono::seconds(3);

}  // namespace

bool LinkPace::is_due(SteadyTime now) const {
  return now - looked_at_ >= kLookInterval;
}

void LinkPace::look(SteadyTime now, std::uint64_t octets_sent, const Audience& audience) {
  const double sent_bit_s = 8.0 *
                            static_cast<double>(octets_sent - std::min(octets_sent, sent_then_)) /
                            to_seconds(now - looked_at_);
  looked_at_ = now;
  sent_then_ = octets_sent;
  const bool late = audience.round_trip && *audience.round_trip > kUsual;
  // Once is a machine that was busy for a moment.
  if (late && is_late_ && now >= settled_at_) slow_down(now, sent_bit_s, audience);
  if (!late) speed_up();
  is_late_ = late;
}

void LinkPace::slow_down(SteadyTime now, double sent_bit_s, const Audience& audience) {
  const auto receivers = static_cast<double>(std::max(audience.receivers, kFewReceivers));
  const double least_bit_s = std::min(kLeastEach_bit_s * receivers, most_bit_s_);
  const double passed_bit_s = std::clamp(sent_bit_s, least_bit_s, rate_bit_s_);
  const double beyond = to_seconds(*audience.round_trip - kUsual) / to_seconds(kMuchBeyond);
  rate_bit_s_ = std::max(least_bit_s, passed_bit_s * (1.0 - kMostSlower * std::min(beyond, 1.0)));
  passed_bit_s_ = passed_bit_s;
  settled_at_ = now + kSettling;
}

/// Near what the link passed by hundredths, so that it does not fill up at once; by more below
/// that, and beyond it, where the link has evidently become better.
void LinkPace::speed_up() {
  constexpr double kBelow = 1.1, kNear = 1.02, kBeyond = 1.3;
  double faster = kBeyond;
  if (passed_bit_s_) faster = rate_bit_s_ < 0.8 * *passed_bit_s_ ? kBelow : kNear;
  rate_bit_s_ = std::min(most_bit_s_, faster * rate_bit_s_);
  if (passed_bit_s_ && rate_bit_s_ > 1.25 * *passed_bit_s_) passed_bit_s_.reset();
}

}  // namespace lifeline::sharing
