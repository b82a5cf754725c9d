#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/time.hpp"

namespace lifeline::sharing {

/// Who listens.
struct Audience {
  std::size_t receivers = 0;
  /// The least with any receiver (Roster::round_trip), nullopt where none is known.
  std::optional<Duration> round_trip{};
};

/// What a link passes, found by how long our samples take to others and their answers back
/// (docs/decisions/0119): less than is configured where they queue up, and more again, gently,
/// while they do not. A link's queue that is full delays what is urgent, too. One owner, not
/// thread-safe.
class LinkPace {
 public:
  explicit LinkPace(double most_bit_s) : most_bit_s_(most_bit_s), rate_bit_s_(most_bit_s) {}

  /// Whether it is time to look() again: once a second.
  [[nodiscard]] bool is_due(SteadyTime now) const;
  /// `octets_sent`: everything that has left so far.
  void look(SteadyTime now, std::uint64_t octets_sent, const Audience& audience);

  [[nodiscard]] double rate_bit_s() const { return rate_bit_s_; }
  /// Whether our samples wait in the link's queue, as of the last look.
  [[nodiscard]] bool is_late() const { return is_late_; }

 private:
  void slow_down(SteadyTime now, double sent_bit_s, const Audience& audience);
  void speed_up();

  double most_bit_s_, rate_bit_s_;
  std::optional<double> passed_bit_s_;  ///< what the link passed when last it was full
  SteadyTime looked_at_{}, settled_at_{};
  std::uint64_t sent_then_ = 0;
  bool is_late_ = false;
};

}  // namespace lifeline::sharing
