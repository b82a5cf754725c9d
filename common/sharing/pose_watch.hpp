#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// The newest pose of each helmet, and how many were lost on the way. One owner, not thread-safe.
class PoseWatch {
 public:
  struct Entry {
    wire::HelmetPose pose;
    SteadyTime heard_at;
    double loss = 0.0;  ///< share of the last kWindow poses that did not arrive, 0 to 1
    std::uint64_t window_begin = 0;
    std::uint64_t window_heard = 0;
  };
  static constexpr std::uint64_t kWindow = 50;  ///< five seconds' poses

  /// Takes in a pose that was accepted. False: older than what is held, or one helmet too many.
  bool hear(const wire::HelmetPose& pose, SteadyTime now);

  [[nodiscard]] const std::map<std::string, Entry>& entries() const { return entries_; }
  /// nullptr where no pose of it was heard.
  [[nodiscard]] const Entry* find(const std::string& agent_id) const;

 private:
  std::map<std::string, Entry> entries_;
};

}  // namespace lifeline::sharing
