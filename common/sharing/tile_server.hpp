#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/link_budget.hpp"
#include "common/sharing/replica_store.hpp"
#include "common/sharing/token_bucket.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::sharing {

/// Sends tiles that others asked this participant for, within a share of its budget: its own
/// layer's and those that it holds of others. What is asked for twice is sent once. One owner, not
/// thread-safe.
class TileServer {
 public:
  static constexpr std::size_t kMaxWaiting = ReplicaStore::kMaxTilesPerLayer;

  /// `share_bit_s`: most payload of tiles that are sent again.
  /// `own_layer`: a helmet's; empty: a coordinator.
  TileServer(Speaker speaker, std::optional<LayerKey> own_layer, double share_bit_s,
             wire::Outbox<wire::TileCopy>& outbox);

  /// Notes what a request lacks. An error (unknown layer name, ends in the wrong order, too much
  /// asked for) names it. Requests to others are none of our business.
  [[nodiscard]] Result<void> take(const wire::TileRequest& request, const ReplicaStore& store);

  /// Tiles of the own layer that somebody holds newer than this participant does, as they say: of a
  /// process before this one, whose disk took no more (docs/decisions/0601). Since the last call.
  [[nodiscard]] std::map<TileIndex, Revision> take_newer_elsewhere() {
    return std::exchange(newer_elsewhere_, {});
  }

  /// Sends what the budget allows. An error names the sample that the middleware refused; the
  /// requester will ask again.
  [[nodiscard]] Result<void> step(SteadyTime now, Timestamp wall_now, const ReplicaStore& store,
                                  LinkBudget& link);

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  [[nodiscard]] Result<void> send(const LayerKey& layer, TileIndex tile, Timestamp wall_now,
                                  const ReplicaStore& store, LinkBudget& link);

  void note_newer(const std::map<TileIndex, Revision>& theirs, const ReplicaStore& store);

  AgentId self_;
  std::optional<LayerKey> own_layer_;
  EnvelopeStamper stamper_;
  TokenBucket bucket_;
  wire::Outbox<wire::TileCopy>& outbox_;
  std::set<std::pair<LayerKey, TileIndex>> waiting_;
  std::map<TileIndex, Revision> newer_elsewhere_;
};

}  // namespace lifeline::sharing
