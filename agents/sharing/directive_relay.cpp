#include "agents/sharing/directive_relay.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/sharing/groups.hpp"

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

/// Whether a helmet of the own group makes another common map of the same tiles and epoch: then
/// two coordinators wrote a directive of that epoch.
bool follows_another(const wire::AgentStatus& theirs, const Followed& own) {
  if (theirs.epoch_applied != own.directive.epoch || !holds_another_map(theirs, own.said))
    return false;
  const auto group = [&](const wire::AgentStatus& of) {
    const auto layer = to_layer_key({of.agent_id, of.map_id, of.floor});
    return layer ? group_of(own.directive, *layer) : std::vector<Placement>{};
  };
  const auto shared = group(own.said);
  return !shared.empty() && shared == group(theirs);
}

}  // namespace

bool DirectiveRelay::needs_it(const Roster::Entry& entry, const Roster& roster,
                              const Followed& own) const {
  const auto& status = entry.status;
  return status.role == wire::Role::helmet && holds(status.peers_heard, self_.text()) &&
         !has_leader(status.peers_heard, roster) &&
         (status.epoch_applied < own.directive.epoch || follows_another(status, own));
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

bool DirectiveRelay::is_due(SteadyTime now, const Roster& roster, const Followed& own) {
  const Epoch epoch{own.directive.epoch};
  std::map<std::string, SteadyTime> behind;
  bool due = contradicted_;
  for (const auto& [id, entry] : roster.entries()) {
    if (Roster::presence(entry, now) == Presence::lost || !needs_it(entry, roster, own)) continue;
    const auto known = behind_since_.find(id);
    const SteadyTime since = known == behind_since_.end() ? now : known->second;
    behind.emplace(id, since);
    due = due || now - since >= config_.patience * (1 + rank_for(entry, now, roster, epoch));
  }
  behind_since_ = std::move(behind);
  if (!due || (told_at_ != SteadyTime{} && now - told_at_ < config_.repeat_after)) return false;
  contradicted_ = false;
  told_at_ = now;
  return true;
}

Result<bool> DirectiveRelay::may_follow(const wire::DirectiveCopy& copy, SteadyTime now,
                                        const Roster& roster, const wire::MergeDirective& own) {
  const auto& directive = copy.directive;
  if (copy.teller_id != copy.envelope.sender_id ||
      directive.envelope.mission_id != copy.envelope.mission_id ||
      directive.mission_id != copy.envelope.mission_id) {
    return fail(ErrorCode::bad_data, "{} tells a directive that is not of this mission or not its",
                copy.envelope.sender_id);
  }
  if (!is_believable(Epoch{directive.epoch}, Epoch{own.epoch})) {
    return fail(ErrorCode::bad_data, "{} tells a directive whose epoch {} is too far ahead of {}",
                copy.teller_id, directive.epoch, own.epoch);
  }
  if (has_leader(roster.present(now), roster)) return false;
  contradicted_ = contradicted_ || (directive.epoch == own.epoch && outranks(own, directive));
  return outranks(directive, own);
}

}  // namespace lifeline::sharing
