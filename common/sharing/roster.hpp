#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

enum class Presence { fresh, late, lost };

/// How long a sender may be silent, by our own clock (not by what the middleware says).
inline constexpr Duration kLateAfter = std::chrono::seconds(2);
inline constexpr Duration kLostAfter = std::chrono::seconds(5);

/// The newest status of everybody heard, and since when they are silent. One owner, not
/// thread-safe.
class Roster {
 public:
  static constexpr std::size_t kMaxEntries = 64;

  struct Entry {
    wire::AgentStatus status;
    SteadyTime heard_at;
    /// Another living process with the same id, if one was heard while this one was.
    bool contested = false;
    /// How much later than the quickest of the last minute this status came. Whose clocks differ
    /// does not matter, as long as both go.
    Duration delay{};
    /// Of (when a status came, by our clock) less (when it left, by the sender's): the least of
    /// the current half minute and of the one before.
    struct Quickest {
      double now_s = 0.0, before_s = 0.0;
      SteadyTime since{};
    } quickest{};
  };

  /// Takes in a status whose envelope was accepted. False: older than what is held, or not of its
  /// sender: ignored.
  bool hear(const wire::AgentStatus& status, SteadyTime now);

  [[nodiscard]] const std::map<std::string, Entry>& entries() const { return entries_; }
  /// nullptr when nothing was ever heard of `agent_id`.
  [[nodiscard]] const Entry* find(const std::string& agent_id) const;
  [[nodiscard]] static Presence presence(const Entry& entry, SteadyTime now);
  /// Ids of everybody who is not lost.
  [[nodiscard]] std::vector<std::string> present(SteadyTime now) const;

  /// Says in a status whom we hear, and how late. No more than a sample has room for.
  void tell_peers(SteadyTime now, wire::AgentStatus& status) const;
  /// How late our own samples come to those who hear us, as they say: the least of all, since what
  /// delays them for everybody is our own link. nullopt where nobody says.
  [[nodiscard]] std::optional<Duration> own_delay(const std::string& self, SteadyTime now) const;

 private:
  std::map<std::string, Entry> entries_;
};

}  // namespace lifeline::sharing
