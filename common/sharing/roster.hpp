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

  /// Says in a status whom we hear, and echoes their clocks. No more than a sample has room for.
  void tell_peers(SteadyTime now, wire::AgentStatus& status) const;
  /// How long our own samples are on their way to those who hear us, and their answers back: the
  /// least of all, since what delays them for everybody is our own link. nullopt where nobody
  /// echoes. `wall_now`: by the clock that our envelopes tell.
  [[nodiscard]] std::optional<Duration> round_trip(const std::string& self, SteadyTime now,
                                                   Timestamp wall_now) const;

 private:
  std::map<std::string, Entry> entries_;
};

}  // namespace lifeline::sharing
