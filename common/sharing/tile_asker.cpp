#include "common/sharing/tile_asker.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "common/sharing/accept.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::sharing {
namespace {

constexpr TileIndex kBeforeAll{std::numeric_limits<std::int32_t>::min(),
                               std::numeric_limits<std::int32_t>::min()};
constexpr TileIndex kLastOfAll{std::numeric_limits<std::int32_t>::max(),
                               std::numeric_limits<std::int32_t>::max()};

// Who tells of a layer, in the order in which they are asked.
struct Teller {
  enum class Rank { owner, coordinator, helmet } rank;
  std::string id;
  auto operator<=>(const Teller&) const = default;
};

// After a restart a helmet knows its former layer no better than others do.
Teller::Rank rank_of(const wire::AgentStatus& status, const LayerKey& layer) {
  if (wire::LayerName{status.agent_id, status.map_id, status.floor} == to_layer_name(layer))
    return Teller::Rank::owner;
  return status.role == wire::Role::coordinator ? Teller::Rank::coordinator : Teller::Rank::helmet;
}

}  // namespace

TileAsker::TileAsker(AgentId self, std::optional<LayerKey> own_layer, TileAskerConfig config)
    : self_(std::move(self)), own_layer_(std::move(own_layer)), config_(config) {}

std::optional<wire::TileRequest> TileAsker::step(SteadyTime now, const Roster& roster,
                                                 const ReplicaStore& store) {
  if (now >= review_due_) {
    review_due_ = now + config_.review_interval;
    review(now, roster, store);
  }
  if (now < request_due_) return std::nullopt;
  for (auto& [layer, want] : wants_) {
    const bool under_way = want.asked_to.has_value();
    if (!under_way && !is_due(want, now)) continue;
    request_due_ = now + config_.request_interval;
    return next_window(layer, want, now, store);
  }
  return std::nullopt;
}

std::size_t TileAsker::layers_behind(SteadyTime now) const {
  return static_cast<std::size_t>(std::count_if(wants_.begin(), wants_.end(), [&](const auto& w) {
    return now - w.second.since >= config_.patience;
  }));
}

bool TileAsker::is_due(const Want& want, SteadyTime now) const {
  const Duration patience = want.lacks_many ? config_.patience_for_many : config_.patience;
  const bool quiet = now - std::max(want.since, want.gained_at) >= patience;
  return (quiet && now >= want.round_due) ||
         now - std::max(want.since, want.asked_at) >= config_.long_patience;
}

void TileAsker::review(SteadyTime now, const Roster& roster, const ReplicaStore& store) {
  const auto differing = differences(now, roster, store);
  std::erase_if(wants_, [&](const auto& want) { return !differing.contains(want.first); });
  for (const auto& [layer, difference] : differing) {
    const auto [found, is_new] = wants_.try_emplace(layer);
    Want& want = found->second;
    want.able = difference.able;
    want.lacks_many = difference.lacks_many;
    if (is_new) want.since = now;
    if (!is_new && want.held == difference.held) continue;
    want.held = difference.held;
    want.gained_at = now;
    want.rounds = 0;
    if (!want.asked_to) want.round_due = now;
  }
}

std::map<LayerKey, TileAsker::Difference> TileAsker::differences(SteadyTime now,
                                                                 const Roster& roster,
                                                                 const ReplicaStore& store) const {
  std::map<LayerKey, RevisionDigest> held;
  std::map<LayerKey, std::map<Teller, wire::LayerDigest>> tellers;
  std::set<LayerKey> complete;  // as their owners say
  for (const auto& [id, entry] : roster.entries()) {
    if (id == self_.text() || Roster::presence(entry, now) == Presence::lost) continue;
    for (const wire::LayerDigest& told : entry.status.layers) {
      const auto layer = to_layer_key(told.layer);
      if (!layer || *layer == own_layer_) continue;
      if (!held.contains(*layer)) held.emplace(*layer, store.digest(*layer));
      const Teller teller{rank_of(entry.status, *layer), id};
      if (told.revisions != held.at(*layer)) {
        tellers[*layer].emplace(teller, told);
      } else if (teller.rank == Teller::Rank::owner) {
        complete.insert(*layer);
      }
    }
  }
  std::map<LayerKey, Difference> differing;
  for (const auto& [layer, of_layer] : tellers) {
    if (complete.contains(layer) || differing.size() == ReplicaStore::kMaxLayers) continue;
    Difference& difference = differing[layer];
    difference.held = held.at(layer);
    const ReplicaLayer* tiles = store.find(layer);
    const std::size_t many = (tiles == nullptr ? 0 : tiles->size()) + config_.many_tiles;
    const auto& [first, newest] = *of_layer.begin();
    for (const auto& [teller, told] : of_layer) {
      // While the owner is heard nobody can know more than it does, but some as much: they are
      // asked where it does not answer.
      if (first.rank == Teller::Rank::owner && told.revisions != newest.revisions) continue;
      difference.able.push_back(teller.id);
      difference.lacks_many = difference.lacks_many || told.tiles >= many;
    }
  }
  return differing;
}

wire::TileRequest TileAsker::next_window(const LayerKey& layer, Want& want, SteadyTime now,
                                         const ReplicaStore& store) const {
  if (!want.asked_to) {
    want.asked_to = kBeforeAll;
    want.asked_at = now;
    want.asked_id = want.able[want.rounds % want.able.size()];
  }
  wire::TileRequest request;
  request.requester_id = self_.text();
  request.asked_id = want.asked_id;
  request.layer = to_layer_name(layer);
  request.after_x = want.asked_to->x;
  request.after_y = want.asked_to->y;
  TileIndex to = kLastOfAll;
  if (const ReplicaLayer* tiles = store.find(layer); tiles != nullptr) {
    for (auto held = tiles->upper_bound(*want.asked_to); held != tiles->end(); ++held) {
      if (request.held.size() == wire::kMaxTilesPerRequest) {
        to = {request.held.back().x, request.held.back().y};
        break;
      }
      request.held.push_back({held->first.x, held->first.y, held->second.revision.value});
    }
  }
  request.to_x = to.x;
  request.to_y = to.y;
  want.asked_to = to;
  if (to == kLastOfAll) {
    want.asked_to.reset();
    const Duration retry = config_.first_retry * (1U << std::min(want.rounds, 10U));
    want.round_due = now + std::min(retry, config_.last_retry);
    ++want.rounds;
  }
  return request;
}

}  // namespace lifeline::sharing
