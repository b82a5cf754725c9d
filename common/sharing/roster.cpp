#include "common/sharing/roster.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

/// A clock's milliseconds, modulo 2^32.
std::uint32_t to_ms(std::int64_t clock_ns) {
  return static_cast<std::uint32_t>(clock_ns / 1'000'000);
}

}  // namespace

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

void Roster::tell_peers(SteadyTime now, wire::AgentStatus& status) const {
  for (const auto& [id, entry] : entries_) {
    if (presence(entry, now) == Presence::lost) continue;
    if (status.peers_heard.size() == wire::kMaxPeers) return;
    status.peers_heard.push_back(id);
    status.peers_echo_ms.push_back(to_ms(entry.status.envelope.sent_at_ns) +
                                   to_ms((now - entry.heard_at).count()));
  }
}

std::optional<Duration> Roster::round_trip(const std::string& self, SteadyTime now,
                                           Timestamp wall_now) const {
  std::optional<Duration> least;
  for (const auto& [id, entry] : entries_) {
    if (presence(entry, now) != Presence::fresh) continue;
    const auto& heard = entry.status.peers_heard;
    const auto own = static_cast<std::size_t>(std::ranges::find(heard, self) - heard.begin());
    if (own >= std::min(heard.size(), entry.status.peers_echo_ms.size())) continue;
    const Timestamp heard_at = wall_now - (now - entry.heard_at);
    // Modulo 2^32; what would be negative is a clock that was set meanwhile.
    const auto took_ms = static_cast<std::int32_t>(to_ms(heard_at.time_since_epoch().count()) -
                                                   entry.status.peers_echo_ms[own]);
    const Duration took = std::chrono::milliseconds(std::max(took_ms, 0));
    least = std::min(least.value_or(took), took);
  }
  return least;
}

}  // namespace lifeline::sharing
