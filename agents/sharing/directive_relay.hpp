#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/sharing/roster.hpp"
#include "common/wire/channel.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// A helmet's ends of the topic by which helmets tell the directive to one another.
struct RelayChannels {
  std::unique_ptr<wire::Outbox<wire::DirectiveCopy>> tell;
  std::unique_ptr<wire::Inbox<wire::DirectiveCopy>> told;
};

struct DirectiveRelayConfig {
  /// Who would tell it first does so once somebody has been behind for so long, the next one after
  /// twice that, and so on.
  Duration patience = std::chrono::seconds(2);
  Duration repeat_after = std::chrono::seconds(4);
};

/// The directive that a helmet follows, and the last status in which it said what it holds.
struct Followed {
  const wire::MergeDirective& directive;
  const wire::AgentStatus& said;
};

/// Decides when a helmet tells the directive that it follows to others, and which one of others it
/// may follow: those who hear the coordinator need no other word (docs/decisions/0112). One owner,
/// not thread-safe.
class DirectiveRelay {
 public:
  explicit DirectiveRelay(AgentId self, DirectiveRelayConfig config = {})
      : self_(std::move(self)), config_(config) {}

  /// Whether to tell `own` directive now: a helmet that hears this one, but no coordinator that
  /// leads, follows an older one, or another one of the same epoch, and those who come before this
  /// one by name have not helped. True once each `repeat_after` at most.
  [[nodiscard]] bool is_due(SteadyTime now, const Roster& roster, const Followed& own);

  /// Whether a copy may be followed by who follows `own`: false where a coordinator that leads is
  /// heard, whose own word counts, or where `own` outranks it: one of the same epoch is answered
  /// with that. bad_data where it is not its sender's, or where its epoch is so far ahead that no
  /// coordinator could outrank it any more.
  [[nodiscard]] Result<bool> may_follow(const wire::DirectiveCopy& copy, SteadyTime now,
                                        const Roster& roster, const wire::MergeDirective& own);

 private:
  [[nodiscard]] bool needs_it(const Roster::Entry& entry, const Roster& roster,
                              const Followed& own) const;
  /// How many others that it hears come before this one.
  [[nodiscard]] unsigned rank_for(const Roster::Entry& entry, SteadyTime now, const Roster& roster,
                                  Epoch epoch) const;

  AgentId self_;
  DirectiveRelayConfig config_;
  std::map<std::string, SteadyTime> behind_since_;
  SteadyTime told_at_{};
  bool contradicted_ = false;  ///< by one that the own directive outranks
};

}  // namespace lifeline::sharing
