#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "agents/sharing/helmet_sharing.hpp"

namespace lifeline {

/// Between a helmet's SLAM thread and its sharing thread. Bounded by coalescing: of each tile, and
/// of the state, only the newest is kept. Nobody ever waits for the other longer than a copy takes.
class Mailbox {
 public:
  // SLAM's side. `scanned_at`: when the oldest scan in `tiles` was taken that was not in those
  // before; zero: none.
  void put(const sharing::MapTiles& tiles, sharing::HelmetState state, SteadyTime scanned_at = {}) {
    std::lock_guard lock(mutex_);
    if (scanned_at_ == SteadyTime{}) scanned_at_ = scanned_at;
    for (const auto& [tile, cells] : tiles) tiles_[tile] = cells;
    state_ = std::move(state);
  }
  [[nodiscard]] std::optional<sharing::PeerUpdate> take_peers() {
    std::lock_guard lock(mutex_);
    if (peer_tiles_.empty()) return std::nullopt;
    sharing::PeerUpdate update{{peer_tiles_.begin(), peer_tiles_.end()}, own_weight_};
    peer_tiles_.clear();
    return update;
  }

  // Sharing's side.
  void put_peers(const sharing::PeerUpdate& update) {
    std::lock_guard lock(mutex_);
    for (const auto& [tile, cells] : update.tiles) peer_tiles_[tile] = cells;
    own_weight_ = update.own_weight;
  }
  struct Mapped {
    sharing::MapTiles tiles;
    sharing::HelmetState state;
    SteadyTime scanned_at{};  ///< the oldest scan in `tiles`; zero: none
  };
  [[nodiscard]] std::optional<Mapped> take_mapped() {
    std::lock_guard lock(mutex_);
    if (!state_) return std::nullopt;
    Mapped mapped{
        {tiles_.begin(), tiles_.end()}, *std::exchange(state_, {}), std::exchange(scanned_at_, {})};
    tiles_.clear();
    return mapped;
  }

 private:
  std::mutex mutex_;
  std::map<TileIndex, std::shared_ptr<const QuantisedTile>> tiles_;
  std::optional<sharing::HelmetState> state_;
  SteadyTime scanned_at_{};
  std::map<TileIndex, std::shared_ptr<const TsdTile>> peer_tiles_;
  double own_weight_ = 0.5;
};

}  // namespace lifeline
