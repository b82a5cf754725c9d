#include "common/sharing/tile_server.hpp"

#include <algorithm>

#include "common/sharing/accept.hpp"
#include "common/sharing/tile_samples.hpp"

namespace lifeline::sharing {

TileServer::TileServer(Speaker speaker, std::optional<LayerKey> own_layer, double share_bit_s,
                       wire::Outbox<wire::TileCopy>& outbox)
    : self_(speaker.id),
      own_layer_(std::move(own_layer)),
      stamper_(std::move(speaker)),
      bucket_(share_bit_s),
      outbox_(outbox) {}

Result<void> TileServer::take(const wire::TileRequest& request, const ReplicaStore& store) {
  if (request.asked_id != self_.text() || request.requester_id == self_.text()) return {};
  const auto layer = to_layer_key(request.layer);
  if (!layer) return forward_error(layer);
  const TileIndex after{request.after_x, request.after_y}, to{request.to_x, request.to_y};
  if (after >= to) {
    return fail(ErrorCode::bad_data, "{} asks for tiles after ({}, {}) and up to ({}, {})",
                request.requester_id, after.x, after.y, to.x, to.y);
  }
  std::map<TileIndex, Revision> held;
  for (const auto& tile : request.held) held[{tile.x, tile.y}] = Revision{tile.revision_held};
  const ReplicaLayer* tiles = store.find(*layer);
  if (own_layer_ == *layer) note_newer(held, store);
  if (tiles == nullptr) return {};
  for (auto tile = tiles->upper_bound(after); tile != tiles->end() && tile->first <= to; ++tile) {
    if (const auto theirs = held.find(tile->first);
        theirs != held.end() && theirs->second >= tile->second.revision) {
      continue;
    }
    if (waiting_.size() >= kMaxWaiting) {
      return fail(ErrorCode::bad_data, "{} tiles are waiting to be sent again; {} must ask later",
                  waiting_.size(), request.requester_id);
    }
    waiting_.emplace(*layer, tile->first);
  }
  return {};
}

void TileServer::note_newer(const std::map<TileIndex, Revision>& theirs,
                            const ReplicaStore& store) {
  for (const auto& [tile, revision] : theirs) {
    const ReplicaTile* held = store.find(*own_layer_, tile);
    if (held != nullptr && held->revision >= revision) continue;
    if (newer_elsewhere_.size() >= kMaxWaiting) return;
    Revision& newest = newer_elsewhere_[tile];
    newest = std::max(newest, revision);
  }
}

Result<void> TileServer::step(SteadyTime now, Timestamp wall_now, const ReplicaStore& store,
                              LinkBudget& link) {
  bucket_.refill(now);
  while (!waiting_.empty() && bucket_.allows() && link.allows(Traffic::tile)) {
    const auto next = waiting_.extract(waiting_.begin()).value();
    if (auto sent = send(next.first, next.second, wall_now, store, link); !sent) return sent;
  }
  return {};
}

Result<void> TileServer::send(const LayerKey& layer, TileIndex tile, Timestamp wall_now,
                              const ReplicaStore& store, LinkBudget& link) {
  const ReplicaLayer* tiles = store.find(layer);
  if (tiles == nullptr || !tiles->contains(tile)) return {};
  const ReplicaTile& held = tiles->at(tile);
  for (auto& part : tile_samples(layer, tile, held.revision, *held.cells, store.geometry())) {
    wire::TileCopy copy{std::move(part)};
    copy.envelope = stamper_.next(wall_now);
    bucket_.spend_octets(copy.payload.size());
    link.expect(copy.payload.size());
    if (auto sent = outbox_.put(copy); !sent) return sent;
  }
  return {};
}

}  // namespace lifeline::sharing
