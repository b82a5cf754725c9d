#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Names an alert in a mission.
using AlertKey = std::pair<std::string, std::uint32_t>;  // issuer_id, alert_id

/// Everybody's alerts, the own ones included, and who answered. An alert belongs to its issuer, who
/// alone says what it is about; whoever answers sends it back with their own name. What is held
/// only grows (raised, acknowledged, cleared; one more name), so that order and repeats change
/// nothing. One owner, not thread-safe.
class AlertList {
 public:
  static constexpr std::size_t kMostPerSender = 64;  ///< its own, and those only it has answered
  static constexpr std::size_t kMost = 512;

  struct Entry {
    wire::Alert alert;       ///< with every answer so far, names in ascending order
    SteadyTime heard_at;     ///< for the first time
    std::string brought_by;  ///< who takes this place in the list: its issuer, once heard
    bool is_told = false;    ///< its issuer was heard: until then only answers are known
    /// The issuer's newest sample named all who are named here.
    bool is_gathered = false;
  };

  /// Takes in an alert, or somebody's answer to it, whose envelope was accepted. `from_command`:
  /// its sender may end what others raised. True: something is new. An error (no such kind or
  /// state, a name that is none, one too many) changes nothing. In a full list whoever takes the
  /// most places gives one to who takes fewer (docs/decisions/0806).
  [[nodiscard]] Result<bool> apply(const wire::Alert& sample, bool from_command, SteadyTime now);

  /// Alerts whose issuer was heard, and answers to those that were not.
  [[nodiscard]] const std::map<AlertKey, Entry>& entries() const { return entries_; }
  /// nullptr where its issuer was not heard.
  [[nodiscard]] const Entry* find(const AlertKey& key) const;

 private:
  using Entries = std::map<AlertKey, Entry>;
  [[nodiscard]] Result<Entry*> room_for(const wire::Alert& sample, SteadyTime now);
  /// Who has to go so that `sender` has a place; end() where nobody has.
  [[nodiscard]] Entries::iterator dispensable_for(const std::string& sender);

  Entries entries_;
};

/// Whether `agent_id` is among those who answered.
[[nodiscard]] bool has_answered(const wire::Alert& alert, const std::string& agent_id);

}  // namespace lifeline::sharing
