#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/base/time.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/replica_store.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::sharing {

using MapTiles = std::vector<std::pair<TileIndex, std::shared_ptr<const QuantisedTile>>>;

struct TilePublisherConfig {
  std::uint32_t budget_bit_s = 2'000'000;  ///< of tile payload, averaged over a second
  Duration min_tile_interval =
      std::chrono::milliseconds(500);  ///< between two revisions of one tile
};

/// Publishes a helmet's own changed tiles within its budget: tiles that nobody has yet first, then
/// the most changed. What was published goes into the store as the helmet's own replica, so that it
/// fuses the very bits that everybody else gets.
class TilePublisher {
 public:
  TilePublisher(TilePublisherConfig config, LayerKey layer, Speaker speaker,
                wire::Outbox<wire::TsdTile>& outbox);

  /// Notes changed tiles; a newer state of a waiting tile replaces the older one.
  void put(const MapTiles& tiles);

  /// Publishes what is due. An error names the first sample that the middleware refused; it stays
  /// waiting.
  [[nodiscard]] Result<void> step(SteadyTime now, Timestamp wall_now, ReplicaStore& store);

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Published {
    SteadyTime at;
    std::shared_ptr<const QuantisedTile> cells;
  };
  struct Due {
    TileIndex tile;
    std::size_t changed_cells;
  };

  void refill(SteadyTime now);
  [[nodiscard]] std::vector<Due> due(SteadyTime now);
  [[nodiscard]] std::size_t changed_cells(TileIndex tile, const QuantisedTile& cells) const;
  [[nodiscard]] Result<void> publish(TileIndex tile, SteadyTime now, Timestamp wall_now,
                                     ReplicaStore& store);
  [[nodiscard]] Result<void> send(TileIndex tile, Revision revision, Timestamp wall_now,
                                  const std::vector<std::uint8_t>& payload);

  TilePublisherConfig config_;
  LayerKey layer_;
  EnvelopeStamper stamper_;
  wire::Outbox<wire::TsdTile>& outbox_;
  std::map<TileIndex, std::shared_ptr<const QuantisedTile>> waiting_;
  std::map<TileIndex, Published> published_;
  /// Also of what was sent in part only: no two contents may share a revision.
  std::map<TileIndex, Revision> newest_revisions_;
  double allowance_bits_;
  SteadyTime refilled_at_{};
};

}  // namespace lifeline::sharing
