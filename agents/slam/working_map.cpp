#include "agents/slam/working_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline::slam {

TsdCell blended(TsdCell own, TsdCell peer, double w_T1) {
  if (!peer.known()) return own;
  if (!own.known()) return peer;
  const double tsd = w_T1 * own.tsd + (1.0 - w_T1) * peer.tsd;
  return {static_cast<std::int16_t>(std::lround(tsd)), std::max(own.weight, peer.weight)};
}

void WorkingMap::note_own_changed(std::span<const TileIndex> tiles) {
  if (peers_.empty()) return;
  for (const TileIndex tile : tiles) {
    const auto peer = peers_.find(tile);
    if (peer != peers_.end()) peer->second.stale = true;
  }
}

void WorkingMap::set_peer_tile(TileIndex tile, std::shared_ptr<const TsdTile> cells) {
  LIFELINE_CHECK(is_in_range(tile));
  if (cells == nullptr) {
    peers_.erase(tile);
    return;
  }
  PeerTile& peer = peers_[tile];
  peer.cells = std::move(cells);
  peer.stale = true;
}

void WorkingMap::clear_peers() {
  peers_.clear();
}

void WorkingMap::set_own_weight(double w_T1) {
  LIFELINE_CHECK(w_T1 >= 0.0 && w_T1 <= 1.0);
  if (w_T1 == own_weight_) return;
  own_weight_ = w_T1;
  for (auto& [tile, peer] : peers_) peer.stale = true;
}

std::vector<TileIndex> WorkingMap::tiles() const {
  std::vector<TileIndex> tiles = own_.tiles();
  const auto owns = static_cast<std::ptrdiff_t>(tiles.size());
  for (const auto& [tile, peer] : peers_) {
    if (own_.find(tile) == nullptr) tiles.push_back(tile);
  }
  std::sort(tiles.begin() + owns, tiles.end());
  std::inplace_merge(tiles.begin(), tiles.begin() + owns, tiles.end());
  return tiles;
}

const TsdTile* WorkingMap::find(TileIndex tile) const {
  const TsdTile* own = own_.find(tile);
  if (peers_.empty()) return own;
  const auto found = peers_.find(tile);
  if (found == peers_.end()) return own;
  const PeerTile& peer = found->second;
  if (own == nullptr) return peer.cells.get();
  if (peer.stale) {
    if (peer.blended == nullptr) peer.blended = std::make_unique<TsdTile>();
    std::transform(own->begin(), own->end(), peer.cells->begin(), peer.blended->begin(),
                   [this](TsdCell a, TsdCell b) { return slam::blended(a, b, own_weight_); });
    peer.stale = false;
  }
  return peer.blended.get();
}

}  // namespace lifeline::slam
