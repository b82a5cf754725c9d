#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/sharing/link_pace.hpp"
#include "common/sharing/roster.hpp"

namespace lifeline::sharing {

/// What a sample is for, most urgent first. Status, directives and alerts are not asked about: they
/// always go.
enum class Traffic { pose, tile, scan };

/// Whom `self` speaks to.
[[nodiscard]] Audience audience(const Roster& roster, const AgentId& self, const Clock& clock);

/// Keeps what a participant really sends to a rate, whatever it sends, and to less where the link
/// passes less (LinkPace): each class may draw on the allowance down to a reserve that is kept for
/// the more urgent ones. Allowance gathers for at most one second. One owner, not thread-safe.
class LinkBudget {
 public:
  /// `octets_sent`: everything that has left so far, as whoever counts it last saw it.
  LinkBudget(double most_bit_s, std::function<std::uint64_t()> octets_sent);

  /// Takes time and the counter into account; to be called before anything is sent. What nobody
  /// announced (heartbeats, repetitions) is charged, but takes no more than 85 % of the rate.
  /// `audience` is asked once a second.
  void measure(SteadyTime now, const std::function<Audience()>& audience);

  /// A sample of so many octets was handed over: it counts at once, for each receiver, and not
  /// again when the counter shows it.
  void expect(std::size_t octets);

  [[nodiscard]] bool allows(Traffic traffic) const;
  /// Whether samples wait in the link's queue (LinkPace::is_late).
  [[nodiscard]] bool is_late() const { return pace_.is_late(); }
  /// Handed over and not yet seen by the counter.
  [[nodiscard]] std::uint64_t octets_queued() const {
    return static_cast<std::uint64_t>(expected_octets_);
  }
  [[nodiscard]] double rate_bit_s() const { return pace_.rate_bit_s(); }
  /// As measure() was told last, one at least.
  [[nodiscard]] std::size_t receivers() const { return receivers_; }

 private:
  LinkPace pace_;
  std::function<std::uint64_t()> octets_sent_;
  double allowance_bits_;
  double expected_octets_ = 0.0;
  double unannounced_bits_ = 0.0;  ///< seen by the counter, announced by nobody, not yet charged
  std::size_t receivers_ = 1;
  std::uint64_t counted_ = 0;
  SteadyTime measured_at_{}, confirmed_at_{};
};

}  // namespace lifeline::sharing
