#include "common/sharing/replica_store.hpp"

#include <algorithm>
#include <utility>

#include "common/base/check.hpp"
#include "common/base/sha256.hpp"
#include "common/sharing/accept.hpp"
#include "common/wire/tile_codec.hpp"

namespace lifeline::sharing {
namespace {

RevisionDigest first_half(const Sha256Digest& digest) {
  RevisionDigest half{};
  std::copy_n(digest.begin(), half.size(), half.begin());
  return half;
}

}  // namespace

Result<Applied> ReplicaStore::apply(const wire::TsdTile& sample) {
  if (sample.envelope.sender_id != sample.layer.agent_id) {
    return fail(ErrorCode::bad_data, "{} sent a tile of {}'s layer; only own layers are published",
                sample.envelope.sender_id, sample.layer.agent_id);
  }
  return take_in(sample);
}

Result<Applied> ReplicaStore::apply(const wire::TileCopy& copy) {
  return take_in(copy);
}

Result<Applied> ReplicaStore::take_in(const wire::TsdTile& sample) {
  auto key = to_layer_key(sample.layer);
  if (!key) return forward_error(key);
  const TileIndex tile{sample.tile_x, sample.tile_y};
  if (auto within = check_limits(*key, tile); !within) return forward_error(within);
  if (sample.revision == 0) {
    return fail(ErrorCode::bad_data, "{} sent a tile of revision 0", sample.layer.agent_id);
  }
  const Revision revision{sample.revision};
  if (const auto* layer = find(*key); layer != nullptr) {
    if (const auto held = layer->find(tile); held != layer->end()) {
      if (held->second.revision == revision) return Applied::repeated;
      if (held->second.revision > revision) return Applied::older;
    }
  }
  const auto cells = join({*key, tile}, sample);
  if (!cells) return forward_error(cells);
  if (!*cells) return Applied::part;
  layers_[*key][tile] = {revision, std::make_shared<const QuantisedTile>(**cells)};
  changed_.push_back({*key, tile});
  if (listener_) listener_(*key, tile, layers_[*key][tile]);
  return Applied::newer;
}

Result<void> ReplicaStore::restore(const LayerKey& layer, TileIndex tile, ReplicaTile held) {
  LIFELINE_CHECK(held.cells != nullptr);
  if (auto within = check_limits(layer, tile); !within) return within;
  ReplicaTile& now = layers_[layer][tile];
  if (now.revision >= held.revision) return {};
  now = std::move(held);
  changed_.push_back({layer, tile});
  return {};
}

Result<std::optional<QuantisedTile>> ReplicaStore::join(const ChangedTile& tile,
                                                        const wire::TsdTile& sample) {
  const std::pair name{tile.layer, tile.tile};
  if (incomplete_.size() >= kMaxIncompleteTiles && !incomplete_.contains(name)) {
    return fail(ErrorCode::bad_data, "{} tiles are incomplete; no more are begun",
                incomplete_.size());
  }
  const auto [parts, is_first] = incomplete_.try_emplace(name);
  auto whole = parts->second.add(sample);
  if (!whole && is_first) incomplete_.erase(parts);
  if (!whole) return forward_error(whole);
  if (parts->second.empty()) incomplete_.erase(parts);
  if (!*whole) return std::nullopt;
  auto cells = wire::decode_tile(**whole, geometry_);
  if (!cells) return forward_error(cells);
  return std::optional(*cells);
}

void ReplicaStore::put_own(const LayerKey& layer, TileIndex tile, Revision revision,
                           std::shared_ptr<const QuantisedTile> cells) {
  LIFELINE_CHECK(cells != nullptr);
  auto& held = layers_[layer][tile];
  LIFELINE_CHECK(held.revision < revision);
  held = {revision, std::move(cells)};
  changed_.push_back({layer, tile});
}

const ReplicaLayer* ReplicaStore::find(const LayerKey& layer) const {
  const auto found = layers_.find(layer);
  return found == layers_.end() ? nullptr : &found->second;
}

const ReplicaTile* ReplicaStore::find(const LayerKey& layer, TileIndex tile) const {
  const ReplicaLayer* tiles = find(layer);
  if (tiles == nullptr) return nullptr;
  const auto found = tiles->find(tile);
  return found == tiles->end() ? nullptr : &found->second;
}

std::vector<ReplicaStore::ChangedTile> ReplicaStore::take_changed() {
  return std::exchange(changed_, {});
}

RevisionDigest ReplicaStore::digest(const LayerKey& layer) const {
  Sha256 hash;
  if (const auto* tiles = find(layer); tiles != nullptr) {
    for (const auto& [tile, held] : *tiles) {
      hash.add_integer(static_cast<std::uint32_t>(tile.x));
      hash.add_integer(static_cast<std::uint32_t>(tile.y));
      hash.add_integer(held.revision.value);
    }
  }
  return first_half(hash.finish());
}

Result<void> ReplicaStore::check_limits(const LayerKey& layer, TileIndex tile) const {
  if (!is_in_range(tile)) {
    return fail(ErrorCode::bad_data, "tile ({}, {}) of {} lies beyond +-{}", tile.x, tile.y,
                to_string(layer), kMaxTileIndex);
  }
  const auto* held = find(layer);
  if (held == nullptr && layers_.size() >= kMaxLayers) {
    return fail(ErrorCode::bad_data, "{} would be layer {}; at most {} are held", to_string(layer),
                layers_.size() + 1, kMaxLayers);
  }
  if (held != nullptr && held->size() >= kMaxTilesPerLayer && !held->contains(tile)) {
    return fail(ErrorCode::bad_data, "{} has more than {} tiles", to_string(layer),
                kMaxTilesPerLayer);
  }
  return {};
}

RevisionDigest fingerprint(Epoch epoch, const std::vector<LayerKey>& members,
                           const ReplicaStore& store) {
  Sha256 hash;
  hash.add_integer(epoch.value);
  for (const LayerKey& member : members) {
    hash.add_text(member.agent_id.text());
    hash.add_integer(member.map_id.value);
    hash.add_integer(static_cast<std::uint16_t>(member.floor.value));
    hash.add(store.digest(member));
  }
  return first_half(hash.finish());
}

TsdGrid to_grid(const ReplicaLayer& layer, const GridGeometry& geometry) {
  TsdGrid grid(geometry);
  for (const auto& [tile, held] : layer) grid.at(tile) = dequantise(*held.cells);
  return grid;
}

}  // namespace lifeline::sharing
