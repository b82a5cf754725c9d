#include "common/sharing/link_budget.hpp"

#include <algorithm>
#include <utility>

#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

// Heartbeats and repetitions end only once everything has arrived: they may slow the tiles down,
// but not stop them.
constexpr double kMostUnannounced = 0.85;
// What the counter has not shown for so long was not sent.
constexpr Duration kForgetAfter = std::chrono::seconds(1);

double reserve_of(Traffic traffic) {
  switch (traffic) {
    case Traffic::pose:
      return 0.0;
    case Traffic::tile:
      return 0.1;
    case Traffic::scan:
      return 0.5;
  }
  return 1.0;
}

}  // namespace

Audience audience(const Roster& roster, const AgentId& self, const Clock& clock) {
  const SteadyTime now = clock.steady_now();
  return {roster.present(now).size(), roster.round_trip(self.text(), now, clock.wall_now())};
}

LinkBudget::LinkBudget(double most_bit_s, std::function<std::uint64_t()> octets_sent)
    : pace_(most_bit_s),
      octets_sent_(std::move(octets_sent)),
      allowance_bits_(most_bit_s),
      counted_(octets_sent_()) {}

void LinkBudget::measure(SteadyTime now, const std::function<Audience()>& audience) {
  const std::uint64_t counted = octets_sent_();
  if (pace_.is_due(now)) {
    const Audience listens = audience();
    receivers_ = std::max<std::size_t>(listens.receivers, 1);
    pace_.look(now, counted, listens);
  }
  const double rate_bit_s = pace_.rate_bit_s();
  const double gained_bits =
      measured_at_ == SteadyTime{} ? 0.0 : to_seconds(now - measured_at_) * rate_bit_s;
  measured_at_ = now;
  allowance_bits_ += gained_bits;
  const double sent = static_cast<double>(counted - std::min(counted, counted_));
  counted_ = counted;
  const double confirmed = std::min(sent, expected_octets_);
  expected_octets_ -= confirmed;
  unannounced_bits_ += 8.0 * (sent - confirmed);
  const double charged = std::min(unannounced_bits_, kMostUnannounced * gained_bits);
  unannounced_bits_ = std::min(unannounced_bits_ - charged, rate_bit_s);
  allowance_bits_ -= charged;
  if (sent > 0.0 || expected_octets_ == 0.0) confirmed_at_ = now;
  if (now - confirmed_at_ > kForgetAfter) {
    allowance_bits_ += 8.0 * std::exchange(expected_octets_, 0.0);
    confirmed_at_ = now;
  }
  allowance_bits_ = std::min(allowance_bits_, rate_bit_s);
}

void LinkBudget::expect(std::size_t octets) {
  const double on_air = static_cast<double>(receivers_ * (octets + wire::kOctetsAboutASample));
  expected_octets_ += on_air;
  allowance_bits_ -= 8.0 * on_air;
}

bool LinkBudget::allows(Traffic traffic) const {
  return allowance_bits_ > reserve_of(traffic) * pace_.rate_bit_s();
}

}  // namespace lifeline::sharing
