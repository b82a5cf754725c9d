#include "agents/sharing/tile_publisher.hpp"

#include <algorithm>

#include "common/sharing/tile_samples.hpp"

namespace lifeline::sharing {

TilePublisher::TilePublisher(TilePublisherConfig config, LayerKey layer, Speaker speaker,
                             wire::Outbox<wire::TsdTile>& outbox)
    : config_(config),
      layer_(std::move(layer)),
      stamper_(std::move(speaker)),
      outbox_(outbox),
      changed_(config.hold_back, config.coarse) {}

Duration TilePublisher::team_interval(std::size_t receivers) const {
  const std::size_t beyond = receivers - std::min(receivers, config_.usual_receivers);
  return static_cast<int>(beyond) * config_.interval_beyond;
}

void TilePublisher::resume(const KeptTiles& tiles, Revision newest_before) {
  newest_before_ = newest_before;
  for (const auto& [tile, kept] : tiles) {
    changed_.set_sent(tile, kept.cells);
    newest_revisions_[tile] = kept.revision;
    again_[tile] = kept;
  }
}

Result<void> TilePublisher::step(SteadyTime now, Timestamp wall_now, ReplicaStore& store,
                                 LinkBudget& link) {
  const double cell_m2 = store.geometry().cell_size_m * store.geometry().cell_size_m;
  changed_.set_least_interval(team_interval(link.receivers()));
  for (const ChangedTiles::Due& next : changed_.due(now, cell_m2)) {
    if (!link.allows(Traffic::tile)) break;
    if (auto sent = publish(next, now, wall_now, store, link); !sent) return sent;
  }
  if (auto sent = publish_outranked(now, wall_now, store, link); !sent) return sent;
  return publish_again(wall_now, link);
}

void TilePublisher::outrank(const std::map<TileIndex, Revision>& elsewhere) {
  for (const auto& [tile, revision] : elsewhere) {
    if (revision > newest_before_) continue;  // no process of ours can have given it
    const auto known = newest_revisions_.find(tile);
    if (known == newest_revisions_.end() || known->second < revision) outranked_.insert(tile);
  }
}

Result<void> TilePublisher::publish_outranked(SteadyTime now, Timestamp wall_now,
                                              ReplicaStore& store, LinkBudget& link) {
  while (!outranked_.empty() && link.allows(Traffic::tile)) {
    const TileIndex tile = *outranked_.begin();
    const ReplicaTile* held = store.find(layer_, tile);
    auto cells = held != nullptr ? held->cells : std::make_shared<const QuantisedTile>();
    if (auto sent = publish({tile, std::move(cells)}, now, wall_now, store, link); !sent)
      return sent;
    outranked_.erase(tile);
  }
  return {};
}

Result<void> TilePublisher::publish_again(Timestamp wall_now, LinkBudget& link) {
  while (!again_.empty() && link.allows(Traffic::tile)) {
    const auto& [tile, kept] = *again_.begin();
    auto samples = tile_samples(layer_, tile, kept.revision, kept.payload);
    if (auto sent = send(std::move(samples), wall_now, link); !sent) return sent;
    again_.erase(again_.begin());
  }
  return {};
}

Result<void> TilePublisher::publish(const ChangedTiles::Due& due, SteadyTime now,
                                    Timestamp wall_now, ReplicaStore& store, LinkBudget& link) {
  const auto& [tile, cells, scanned_at] = due;
  Revision& revision = newest_revisions_[tile];
  revision.value = std::max(revision.value, newest_before_.value) + 1;
  if (auto sent =
          send(tile_samples(layer_, tile, revision, *cells, store.geometry()), wall_now, link);
      !sent) {
    return sent;
  }
  // Held only once it left: what nobody else can get must not be in our own common map either.
  store.put_own(layer_, tile, revision, cells);
  if (listener_) listener_(tile, revision, scanned_at);
  changed_.set_sent(tile, cells, now);
  again_.erase(tile);
  return {};
}

Result<void> TilePublisher::send(std::vector<wire::TsdTile> parts, Timestamp wall_now,
                                 LinkBudget& link) {
  for (wire::TsdTile& part : parts) {
    part.envelope = stamper_.next(wall_now);
    link.expect(part.payload.size());
    if (auto sent = outbox_.put(part); !sent) return sent;
  }
  return {};
}

}  // namespace lifeline::sharing
