#include "common/sharing/alert_list.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "common/base/ids.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

Result<void> check(const wire::Alert& sample) {
  if (auto issuer = AgentId::parse(sample.issuer_id); !issuer) return forward_error(issuer);
  if (!sample.subject_id.empty()) {
    if (auto subject = AgentId::parse(sample.subject_id); !subject) return forward_error(subject);
  }
  if (sample.kind > wire::AlertKind::roll_call || sample.state > wire::AlertState::cleared ||
      sample.text.size() > wire::kMaxAlertText || sample.acknowledged_by.size() > wire::kMaxPeers) {
    return fail(ErrorCode::bad_data, "alert {}/{}: no such kind or state, or too long",
                sample.issuer_id, sample.alert_id);
  }
  for (const auto& name : sample.acknowledged_by) {
    if (auto id = AgentId::parse(name); !id) return forward_error(id);
  }
  return {};
}

bool add_answer(wire::Alert& alert, const std::string& name) {
  auto& names = alert.acknowledged_by;
  const auto at = std::lower_bound(names.begin(), names.end(), name);
  if (at != names.end() && *at == name) return false;
  if (names.size() >= wire::kMaxPeers) return false;
  names.insert(at, name);
  return true;
}

bool raise_state(wire::Alert& alert, wire::AlertState state) {
  if (state <= alert.state) return false;
  alert.state = state;
  return true;
}

}  // namespace

bool has_answered(const wire::Alert& alert, const std::string& agent_id) {
  return std::find(alert.acknowledged_by.begin(), alert.acknowledged_by.end(), agent_id) !=
         alert.acknowledged_by.end();
}

Result<AlertList::Entry*> AlertList::room_for(const wire::Alert& sample, SteadyTime now) {
  const AlertKey key{sample.issuer_id, sample.alert_id};
  if (const auto found = entries_.find(key); found != entries_.end()) return &found->second;
  const auto first = entries_.lower_bound({key.first, 0});
  const auto behind = entries_.upper_bound({key.first, std::numeric_limits<std::uint32_t>::max()});
  const auto lot = static_cast<std::size_t>(std::distance(first, behind));
  if (lot >= kMostPerIssuer || entries_.size() >= kMost) {
    // What is over makes room for what is not.
    const auto over = std::find_if(
        lot >= kMostPerIssuer ? first : entries_.begin(),
        lot >= kMostPerIssuer ? behind : entries_.end(),
        [](const auto& held) { return held.second.alert.state == wire::AlertState::cleared; });
    if (over == (lot >= kMostPerIssuer ? behind : entries_.end())) {
      return fail(ErrorCode::unsupported, "alert {}/{}: more than {} of one issuer, or {} in all",
                  key.first, key.second, kMostPerIssuer, kMost);
    }
    entries_.erase(over);
  }
  Entry entry;
  entry.alert.issuer_id = key.first;
  entry.alert.alert_id = key.second;
  entry.heard_at = now;
  return &entries_.emplace(key, std::move(entry)).first->second;
}

Result<bool> AlertList::apply(const wire::Alert& sample, bool from_command, SteadyTime now) {
  if (auto sound = check(sample); !sound) return forward_error(sound);
  auto room = room_for(sample, now);
  if (!room) return forward_error(room);
  Entry& entry = **room;
  wire::Alert& held = entry.alert;
  bool is_news = false;
  const std::string& sender = sample.envelope.sender_id;
  if (sender == sample.issuer_id) {
    if (!entry.is_told) {
      held.kind = sample.kind;
      held.subject_id = sample.subject_id;
      held.text = sample.text;
      entry.is_told = is_news = true;
    }
    for (const auto& name : sample.acknowledged_by) is_news |= add_answer(held, name);
    is_news |= raise_state(held, sample.state);
    entry.is_gathered = std::all_of(held.acknowledged_by.begin(), held.acknowledged_by.end(),
                                    [&](const auto& name) { return has_answered(sample, name); });
    return is_news;
  }
  // Of an answer its own sender's name is believed, and nothing else.
  if (has_answered(sample, sender) && add_answer(held, sender)) {
    is_news = true;
    entry.is_gathered = false;
  }
  const auto most = from_command ? wire::AlertState::cleared : wire::AlertState::acknowledged;
  return raise_state(held, std::min(sample.state, most)) || is_news;
}

const AlertList::Entry* AlertList::find(const AlertKey& key) const {
  const auto found = entries_.find(key);
  return found == entries_.end() || !found->second.is_told ? nullptr : &found->second;
}

}  // namespace lifeline::sharing
