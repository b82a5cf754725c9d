#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "common/base/check.hpp"
#include "common/base/ids.hpp"
#include "common/grid/tsd_cell.hpp"
#include "common/sharing/replica_store.hpp"
#include "common/sharing/tile_samples.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::test {

inline constexpr const char* kMission = "drill";

inline LayerKey layer(const std::string& agent, std::uint32_t map = 1, std::int16_t floor = 0) {
  return {AgentId::parse(agent).value(), MapId{map}, Floor{floor}};
}

inline wire::Envelope envelope(const std::string& sender, std::uint64_t sequence = 1) {
  wire::Envelope envelope;
  envelope.mission_id = kMission;
  envelope.sender_id = sender;
  envelope.incarnation = 7;
  envelope.sequence = sequence;
  return envelope;
}

/// About half of the cells known, any values.
inline QuantisedTile random_tile(std::mt19937& random) {
  QuantisedTile tile;
  for (auto& cell : tile) {
    if (random() % 2 == 0) continue;
    cell.weight = static_cast<std::uint8_t>(1 + random() % QuantisedCell::kMaxWeight);
    cell.tsd = static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127);
  }
  return tile;
}

/// A corner of known cells: fits into one part.
inline QuantisedTile small_tile(std::mt19937& random) {
  QuantisedTile tile = random_tile(random);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    if (i % kTileSide >= 8 || i / kTileSide >= 8) tile[i] = {};
  }
  return tile;
}

/// All parts of a tile at a revision.
inline std::vector<wire::TsdTile> tile_samples(const LayerKey& key, TileIndex tile,
                                               std::uint64_t revision, const QuantisedTile& cells,
                                               const GridGeometry& geometry = {}) {
  auto samples = sharing::tile_samples(key, tile, Revision{revision}, cells, geometry);
  for (auto& sample : samples) sample.envelope = envelope(key.agent_id.text(), revision);
  return samples;
}

/// A tile that fits into one part.
inline wire::TsdTile tile_sample(const LayerKey& key, TileIndex tile, std::uint64_t revision,
                                 const QuantisedTile& cells, const GridGeometry& geometry = {}) {
  const auto samples = tile_samples(key, tile, revision, cells, geometry);
  LIFELINE_CHECK(samples.size() == 1);
  return samples.front();
}

/// Applies all parts; the last one's outcome.
inline Result<sharing::Applied> apply(sharing::ReplicaStore& store,
                                      const std::vector<wire::TsdTile>& samples) {
  Result<sharing::Applied> outcome = sharing::Applied::older;
  for (const auto& sample : samples) outcome = store.apply(sample);
  return outcome;
}

/// A victim that `key`'s helmet reports at (x, y) in its map frame, first seen and last seen at
/// these seconds of its clock.
inline wire::Detection detection(const LayerKey& key, std::uint32_t id, double x_m, double y_m,
                                 std::int64_t first_s = 1, std::int64_t last_s = 2) {
  wire::Detection sample;
  sample.envelope = envelope(key.agent_id.text());
  sample.agent_id = key.agent_id.text();
  sample.detection_id = id;
  sample.revision = 1;
  sample.map_id = key.map_id.value;
  sample.floor = key.floor.value;
  sample.x_m = x_m;
  sample.y_m = y_m;
  sample.confidence = 0.5F;
  sample.first_seen_at_ns = first_s * 1'000'000'000;
  sample.seen_at_ns = last_s * 1'000'000'000;
  return sample;
}

}  // namespace lifeline::test
