#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "agents/helmet_mapper.hpp"
#include "agents/storage/helmet_memory.hpp"
#include "common/sharing/accept.hpp"
#include "common/store/record_store.hpp"
#include "common/wire/tile_parts.hpp"

namespace lifeline {

/// Keeps on disk what a helmet needs to go on after a restart. What is published goes first (its
/// samples leave after the commit, see store::WriteAheadOutbox), together with the layer's tile
/// that it was made from; the rest of the layer, the trajectory and the counters once a second.
///
/// Two threads use it: the mapping thread calls the first keep(), the sharing thread all others.
class HelmetKeeper {
 public:
  HelmetKeeper(store::RecordStore& records, LayerKey layer);

  /// A new map begins: what was kept of another one goes.
  void begin_map(const store::Records& old);
  /// The map goes on: poses and tiles that are on disk already.
  void go_on(const HelmetMemory& memory);

  /// After some scans.
  void keep(const HelmetMapper& mapper, const sharing::HelmetState& state);

  /// The layer that is mapped now.
  [[nodiscard]] bool holds(const wire::LayerName& layer) const {
    return layer == sharing::to_layer_name(layer_);
  }

  /// A sample of the own layer that wants to leave; the ticket after which it may. Nothing: with
  /// the last part of its tile.
  [[nodiscard]] std::optional<store::RecordStore::Ticket> keep(const wire::TsdTile& sample);
  /// A tile of somebody else.
  void keep(const LayerKey& layer, TileIndex tile, const sharing::ReplicaTile& held);
  void keep(const wire::MergeDirective& directive);

 private:
  using Cells = std::shared_ptr<const TsdTile>;
  using Batch = store::RecordStore::Batch;
  static void add_layer_tile(TileIndex tile, Cells cells, Batch& batch);
  void add_progress(const HelmetMapper& mapper, const sharing::HelmetState& state, Batch& batch);
  void add_path(const HelmetMapper& mapper, Batch& batch);
  void add_piece(Batch& batch) const;

  store::RecordStore& records_;
  const LayerKey layer_;
  // The mapping thread's.
  SteadyTime layer_due_{}, place_due_{};
  std::size_t earlier_ = 0;         ///< poses on disk from before this start
  std::size_t seen_ = 0;            ///< poses of this start
  std::vector<StampedPose> piece_;  ///< the newest, not yet a whole piece
  // The sharing thread's.
  std::map<TileIndex, wire::TileParts> parts_;
  std::map<TileIndex, std::uint64_t> kept_revisions_;
  // Both threads'.
  std::mutex mutex_;
  std::map<TileIndex, Cells> unkept_;  ///< tiles of the layer, newer than on disk
};

}  // namespace lifeline
