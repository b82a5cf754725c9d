#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/sharing/alert_list.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/hear.hpp"
#include "common/sharing/roster.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::sharing {

/// One participant's part in everybody's alerts: hears them, raises its own, answers, and says
/// again what others may have missed (docs/decisions/0802). Without channels it hears and says
/// nothing. One owner, not thread-safe.
class AlertExchange {
 public:
  /// `role`: a coordinator may end what others raised.
  AlertExchange(Speaker speaker, wire::Role role, std::unique_ptr<wire::Inbox<wire::Alert>> inbox,
                std::unique_ptr<wire::Outbox<wire::Alert>> outbox, const Clock& clock);

  /// Takes up its own alerts of before a restart, and says them again. Before the first step().
  /// bad_data where one of them is not its own or cannot be held.
  [[nodiscard]] Result<void> resume(const std::vector<wire::Alert>& own);

  /// Hears what came, and repeats what is due. `roster` tells who is a coordinator.
  void step(const Roster& roster, HearingNotes& notes);

  /// Raises an alert for everybody, or for one participant (`subject_id`).
  [[nodiscard]] Result<AlertKey> raise(wire::AlertKind kind, const std::string& subject_id,
                                       const std::string& text);
  /// Adds its own name to who has answered, and raises the alert's state to `state` if that is
  /// further. not_found where there is no such alert.
  [[nodiscard]] Result<void> answer(const AlertKey& alert, wire::AlertState state);

  [[nodiscard]] const AlertList& list() const { return list_; }
  /// Its own alerts, to be kept through a restart.
  [[nodiscard]] std::vector<wire::Alert> own() const;
  /// Samples that the middleware refused.
  [[nodiscard]] std::uint64_t refused() const { return inbox_ == nullptr ? 0 : inbox_->refused(); }

 private:
  /// Says an alert to everybody, and holds it. An error where it cannot be held.
  [[nodiscard]] Result<void> put(wire::Alert alert);
  void say(wire::Alert alert);
  void repeat(SteadyTime now);
  void reassure(SteadyTime now);

  Speaker speaker_;
  wire::Role role_;
  std::unique_ptr<wire::Inbox<wire::Alert>> inbox_;
  std::unique_ptr<wire::Outbox<wire::Alert>> outbox_;
  const Clock& clock_;
  EnvelopeStamper stamper_;
  AlertList list_;
  Duration reply_after_;  ///< so that a fleet does not answer in one moment
  SteadyTime repeat_due_{}, reassure_due_{};
  std::uint32_t last_id_ = 0;
};

}  // namespace lifeline::sharing
