#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "agents/sharing/changed_tiles.hpp"
#include "common/base/time.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/kept_layers.hpp"
#include "common/sharing/link_budget.hpp"
#include "common/sharing/replica_store.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::sharing {

struct TilePublisherConfig {
  HoldBackConfig hold_back;
  /// Publish coarse cells (wire::coarse) and not those given: an eighth of the octets.
  bool coarse = true;
  /// Each receiver beyond the usual ones sets the revisions of one tile so much further apart:
  /// everybody takes in everybody's (docs/decisions/0120).
  std::size_t usual_receivers = 10;
  Duration interval_beyond = std::chrono::milliseconds(100);
};

/// Publishes a helmet's own changed tiles, once they are due and the link's budget allows. What was
/// published goes into the store as the helmet's own replica, so that it fuses the very bits that
/// everybody else gets.
class TilePublisher {
 public:
  TilePublisher(TilePublisherConfig config, LayerKey layer, Speaker speaker,
                wire::Outbox<wire::TsdTile>& outbox);

  /// Goes on after a restart: `tiles` were published before, and are published again as they were,
  /// for whoever comes later; to whoever has them it changes nothing. Every revision from here on
  /// is above `newest_before`.
  void resume(const KeptTiles& tiles, Revision newest_before);

  /// Notes changed tiles; a newer state of a waiting tile replaces the older one.
  /// `scanned_at`: when the oldest scan was taken that is new in them.
  void put(const MapTiles& tiles, SteadyTime scanned_at = {}) { changed_.put(tiles, scanned_at); }

  /// Publishes tiles anew that others hold at such revisions, where a process before this one gave
  /// them and this one does not know them. A tile that it does not know at all becomes an unknown
  /// one.
  void outrank(const std::map<TileIndex, Revision>& elsewhere);

  /// Hears of each revision that left, and when the oldest scan was taken that it is the first to
  /// hold.
  using Listener = std::function<void(TileIndex, Revision, SteadyTime scanned_at)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  /// Whether no more tiles will come for now.
  void set_finished(bool finished) { changed_.set_finished(finished); }

  /// Publishes what is due. An error names the first sample that the middleware refused; it stays
  /// waiting.
  [[nodiscard]] Result<void> step(SteadyTime now, Timestamp wall_now, ReplicaStore& store,
                                  LinkBudget& link);

  [[nodiscard]] std::size_t waiting() const {
    return changed_.waiting() + again_.size() + outranked_.size();
  }

 private:
  [[nodiscard]] Result<void> publish(const ChangedTiles::Due& due, SteadyTime now,
                                     Timestamp wall_now, ReplicaStore& store, LinkBudget& link);
  [[nodiscard]] Result<void> publish_outranked(SteadyTime now, Timestamp wall_now,
                                               ReplicaStore& store, LinkBudget& link);
  [[nodiscard]] Result<void> publish_again(Timestamp wall_now, LinkBudget& link);
  [[nodiscard]] Result<void> send(std::vector<wire::TsdTile> parts, Timestamp wall_now,
                                  LinkBudget& link);

  [[nodiscard]] Duration team_interval(std::size_t receivers) const;

  TilePublisherConfig config_;
  LayerKey layer_;
  EnvelopeStamper stamper_;
  wire::Outbox<wire::TsdTile>& outbox_;
  ChangedTiles changed_;
  /// Also of what was sent in part only: no two contents may share a revision.
  std::map<TileIndex, Revision> newest_revisions_;
  Revision newest_before_{};  ///< that any process before this one may have given
  std::map<TileIndex, KeptTile> again_;
  std::set<TileIndex> outranked_;
  Listener listener_;
};

}  // namespace lifeline::sharing
