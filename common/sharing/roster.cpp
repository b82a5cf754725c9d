#include "common/sharing/roster.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

constexpr Duration kQuickestOf = std::chrono::seconds(30);

/// Takes in how long a status was on its way, by two clocks that differ by nobody knows what.
/// Returns how much longer than the quickest.
Duration delay_of(Roster::Entry::Quickest& quickest, const wire::Envelope& envelope,
                  SteadyTime now) {
  // In floating point: a sender's time stamp may be anything.
  const double on_its_way_s =
      to_seconds(now.time_since_epoch()) - 1e-9 * static_cast<double>(envelope.sent_at_ns);
  if (now - quickest.since >= kQuickestOf) {
    const bool first = quickest.since == SteadyTime{};
    quickest = {on_its_way_s, first ? on_its_way_s : quickest.now_s, now};
  }
  quickest.now_s = std::min(quickest.now_s, on_its_way_s);
  constexpr double kMost_s = 3600.0;
  const double quickest_s = std::min(quickest.now_s, quickest.before_s);
  return from_seconds(std::min(on_its_way_s - quickest_s, kMost_s));
}

std::uint16_t to_ms(Duration delay) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(
      std::min<std::int64_t>(std::chrono::floor<std::chrono::milliseconds>(delay).count(), kMost));
}

}  // namespace

bool Roster::hear(const wire::AgentStatus& status, SteadyTime now) {
  if (status.agent_id != status.envelope.sender_id) return false;
  const auto found = entries_.find(status.agent_id);
  if (found == entries_.end()) {
    if (entries_.size() >= kMaxEntries) return false;
    Entry entry{status, now};
    (void)delay_of(entry.quickest, status.envelope, now);
    entries_.insert({status.agent_id, std::move(entry)});
    return true;
  }
  Entry& entry = found->second;
  const auto& held = entry.status.envelope;
  const bool same_process = held.incarnation == status.envelope.incarnation;
  if (same_process && status.envelope.sequence <= held.sequence) return false;
  // A reboot silences the old incarnation; two that keep talking are two helmets with one id.
  const bool both_alive = !same_process && now - entry.heard_at < kLateAfter;
  entry.contested = both_alive || (same_process && entry.contested);
  if (!same_process) entry.quickest = {};
  entry.delay = delay_of(entry.quickest, status.envelope, now);
  entry.status = status;
  entry.heard_at = now;
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
    status.peers_delay_ms.push_back(to_ms(entry.delay));
  }
}

std::optional<Duration> Roster::own_delay(const std::string& self, SteadyTime now) const {
  std::optional<Duration> least;
  for (const auto& [id, entry] : entries_) {
    if (presence(entry, now) != Presence::fresh) continue;
    const auto& heard = entry.status.peers_heard;
    const auto own = static_cast<std::size_t>(std::ranges::find(heard, self) - heard.begin());
    if (own >= std::min(heard.size(), entry.status.peers_delay_ms.size())) continue;
    const Duration delay = std::chrono::milliseconds(entry.status.peers_delay_ms[own]);
    least = std::min(least.value_or(delay), delay);
  }
  return least;
}

}  // namespace lifeline::sharing
