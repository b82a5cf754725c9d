#include "agents/sharing/directive_relay.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"

namespace lifeline::sharing {
namespace {

bool leads(const wire::AgentStatus& status) {
  return status.role == wire::Role::coordinator && status.state != wire::AgentState::starting;
}

// Whether one of these ids is a coordinator that leads, as far as is known here.
bool has_leader(const std::vector<std::string>& ids, const Roster& roster) {
  return std::any_of(ids.begin(), ids.end(), [&](const std::string& id) {
    const auto* entry = roster.find(id);
    return entry != nullptr && leads(entry->status);
  });
}

bool holds(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

bool DirectiveRelay::needs_it(const Roster::Entry& entry, const Roster& roster, Epoch epoch) const {
  const auto& status = entry.status;
  return status.role == wire::Role::helmet && status.epoch_applied < epoch.value &&
         holds(status.peers_heard, self_.text()) && !has_leader(status.peers_heard, roster);
}

unsigned DirectiveRelay::rank_for(const Roster::Entry& entry, SteadyTime now, const Roster& roster,
                                  Epoch epoch) const {
  const auto& heard = entry.status.peers_heard;
  return static_cast<unsigned>(std::count_if(heard.begin(), heard.end(), [&](const auto& id) {
    const auto* other = roster.find(id);
    return other != nullptr && id < self_.text() && other->status.role == wire::Role::helmet &&
           other->status.epoch_applied >= epoch.value &&
           Roster::presence(*other, now) != Presence::lost;
  }));
}

bool DirectiveRelay::is_due(SteadyTime now, const Roster& roster, Epoch epoch) {
  std::map<std::string, SteadyTime> behind;
  bool due = false;
  for (const auto& [id, entry] : roster.entries()) {
    if (Roster::presence(entry, now) == Presence::lost || !needs_it(entry, roster, epoch)) continue;
    const auto known = behind_since_.find(id);
    const SteadyTime since = known == behind_since_.end() ? now : known->second;
    behind.emplace(id, since);
    due = due || now - since >= config_.patience * (1 + rank_for(entry, now, roster, epoch));
  }
  behind_since_ = std::move(behind);
  if (!due || (told_at_ != SteadyTime{} && now - told_at_ < config_.repeat_after)) return false;
  told_at_ = now;
  return true;
}

Result<bool> DirectiveRelay::may_follow(const wire::DirectiveCopy& copy, SteadyTime now,
                                        const Roster& roster, Epoch own) const {
  const auto& directive = copy.directive;
  if (copy.teller_id != copy.envelope.sender_id ||
      directive.envelope.mission_id != copy.envelope.mission_id ||
      directive.mission_id != copy.envelope.mission_id) {
    return fail(ErrorCode::bad_data, "{} tells a directive that is not of this mission or not its",
                copy.envelope.sender_id);
  }
  if (!is_believable(Epoch{directive.epoch}, own)) {
    return fail(ErrorCode::bad_data, "{} tells a directive whose epoch {} is too far ahead of {}",
                copy.teller_id, directive.epoch, own.value);
  }
  return directive.epoch > own.value && !has_leader(roster.present(now), roster);
}

}  // namespace lifeline::sharing
