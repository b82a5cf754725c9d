#include "common/sharing/roster.hpp"

namespace lifeline::sharing {

bool Roster::hear(const wire::AgentStatus& status, SteadyTime now) {
  if (status.agent_id != status.envelope.sender_id) return false;
  const auto found = entries_.find(status.agent_id);
  if (found == entries_.end()) {
    if (entries_.size() >= kMaxEntries) return false;
    entries_.insert({status.agent_id, {status, now, false}});
    return true;
  }
  Entry& entry = found->second;
  const auto& held = entry.status.envelope;
  const bool same_process = held.incarnation == status.envelope.incarnation;
  if (same_process && status.envelope.sequence <= held.sequence) return false;
  // A reboot silences the old incarnation; two that keep talking are two helmets with one id.
  const bool both_alive = !same_process && now - entry.heard_at < kLateAfter;
  entry = {status, now, both_alive || (same_process && entry.contested)};
  return true;
}

const Roster::Entry* Roster::find(const std::string& agent_id) const {
  const auto found = entries_.find(agent_id);
  return found == entries_.end() ? nullptr : &found->second;
}

Presence Roster::presence(const Entry& entry, SteadyTime now) {
  const Duration silent = now - entry.heard_at;
  if (silent >= kLostAfter) return Presence::lost;
  return silent >= kLateAfter ? Presence::late : Presence::fresh;
}

std::vector<std::string> Roster::present(SteadyTime now) const {
  std::vector<std::string> ids;
  for (const auto& [id, entry] : entries_) {
    if (presence(entry, now) != Presence::lost) ids.push_back(id);
  }
  return ids;
}

}  // namespace lifeline::sharing
