#include "common/sharing/alert_list.hpp"

#include <algorithm>
#include <map>
#include <utility>

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
  const std::string& sender = sample.envelope.sender_id;
  const auto of_sender = std::ranges::count_if(
      entries_, [&](const auto& held) { return held.second.brought_by == sender; });
  if (static_cast<std::size_t>(of_sender) >= kMostPerSender || entries_.size() >= kMost) {
    const auto gone = dispensable_for(sender);
    if (gone == entries_.end()) {
      return fail(ErrorCode::unsupported, "alert {}/{}: more than {} from {}, or {} in all",
                  key.first, key.second, kMostPerSender, sender, kMost);
    }
    entries_.erase(gone);
  }
  Entry entry;
  entry.alert.issuer_id = key.first;
  entry.alert.alert_id = key.second;
  entry.heard_at = now;
  entry.brought_by = sender;
  return &entries_.emplace(key, std::move(entry)).first->second;
}

AlertList::Entries::iterator AlertList::dispensable_for(const std::string& sender) {
  std::map<std::string, std::size_t> places;
  for (const auto& [key, held] : entries_) ++places[held.brought_by];
  const auto greediest =
      std::ranges::max_element(places, {}, [](const auto& brought) { return brought.second; });
  // At its own bound, a sender finds room among its own; in a full list, with who takes the most.
  const bool own = places[sender] >= kMostPerSender;
  const std::string loser = own ? sender : greediest->first;
  const bool is_fair = !own && greediest->second > places[sender] + 1;
  auto gone = entries_.end();
  for (auto held = entries_.begin(); held != entries_.end(); ++held) {
    const Entry& entry = held->second;
    // What is over makes room for what is not.
    if (entry.alert.state == wire::AlertState::cleared && (!own || entry.brought_by == sender))
      return held;
    if (!is_fair || entry.brought_by != loser) continue;
    const auto worth = [](const Entry& of) { return std::pair(of.is_told, of.heard_at); };
    if (gone == entries_.end() || worth(entry) < worth(gone->second)) gone = held;
  }
  return gone;
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
      entry.brought_by = sender;
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
