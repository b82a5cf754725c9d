#include "common/sharing/one_way_watch.hpp"

#include <algorithm>

#include "common/base/log.hpp"

namespace lifeline::sharing {
namespace {

constexpr Duration kReviewInterval = std::chrono::seconds(1);

bool hears(const wire::AgentStatus& status, const std::string& id) {
  return std::ranges::find(status.peers_heard, id) != status.peers_heard.end();
}

}  // namespace

void OneWayWatch::step(SteadyTime now, const Roster& roster) {
  if (now < review_due_) return;
  review_due_ = now + kReviewInterval;
  std::map<std::string, std::string> unheard, deaf;
  for (const auto& [id, entry] : roster.entries()) {
    if (Roster::presence(entry, now) != Presence::fresh) continue;
    if (!hears(entry.status, self_.text())) deaf.emplace(id, id);
    for (const std::string& peer : entry.status.peers_heard) {
      if (unheard.size() == Roster::kMaxEntries) break;
      const auto* known = roster.find(peer);
      const bool heard = known != nullptr && Roster::presence(*known, now) != Presence::lost;
      if (!heard && peer != self_.text()) unheard.emplace(peer, id);
    }
  }
  note(unheard_, unheard, Side::unheard, now);
  note(deaf_, deaf, Side::deaf, now);
}

void OneWayWatch::note(Pairs& pairs, const std::map<std::string, std::string>& found, Side side,
                       SteadyTime now) const {
  for (auto pair = pairs.begin(); pair != pairs.end();) {
    if (found.contains(pair->first)) {
      ++pair;
      continue;
    }
    if (pair->second.told) {
      spdlog::info("{} and {} hear each other again, or one of them has gone", self_.text(),
                   pair->first);
    }
    pair = pairs.erase(pair);
  }
  for (const auto& [id, by] : found) {
    Pair& pair = pairs.try_emplace(id, Pair{now}).first->second;
    pair.by = by;
    if (pair.told || now - pair.since < kPatience) continue;
    pair.told = true;
    if (side == Side::unheard) {
      spdlog::warn(
          "{} does not hear {}, whom {} hears: its map comes by others; if it lasts, look at both "
          "radios",
          self_.text(), id, by);
    } else {
      spdlog::warn("{} does not hear {}: what this one sends reaches it by others", id,
                   self_.text());
    }
  }
}

std::vector<std::string> OneWayWatch::named(const Pairs& pairs) {
  std::vector<std::string> ids;
  for (const auto& [id, pair] : pairs) {
    if (pair.told) ids.push_back(id);
  }
  return ids;
}

std::vector<std::pair<std::string, std::string>> one_way_pairs(const Roster& roster,
                                                               SteadyTime now) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& [who, entry] : roster.entries()) {
    if (Roster::presence(entry, now) != Presence::fresh) continue;
    for (const auto& [whom, other] : roster.entries()) {
      if (who == whom || Roster::presence(other, now) != Presence::fresh) continue;
      if (!hears(entry.status, whom)) pairs.emplace_back(who, whom);
    }
  }
  return pairs;
}

}  // namespace lifeline::sharing
