#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "common/base/time.hpp"

namespace lifeline::sharing {

/// Counts each sender's samples and names the one that sends more than any sound one does: its
/// samples are taken in all the same, for what it floods is its own map. One owner, not
/// thread-safe.
class FloodWatch {
 public:
  /// A helmet that keeps to the default budget sends a tenth of it.
  static constexpr double kFloodPerSecond = 500.0;
  static constexpr Duration kInterval = std::chrono::seconds(2);
  static constexpr std::size_t kMaxSenders = 64;

  /// A sample was heard. True when it makes the sender one that floods: said in the log as well,
  /// and again only after it kept quiet for an interval.
  bool note(std::string_view topic, const std::string& sender_id, SteadyTime now);

  /// Times that somebody was named.
  [[nodiscard]] std::uint64_t floods() const { return floods_; }

 private:
  struct Sender {
    SteadyTime since{};
    std::uint64_t samples = 0;
    bool floods = false;
  };

  std::map<std::string, Sender> senders_;
  std::uint64_t floods_ = 0;
};

}  // namespace lifeline::sharing
