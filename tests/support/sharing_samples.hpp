#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "common/base/ids.hpp"
#include "common/grid/tsd_cell.hpp"
#include "common/wire/messages.hpp"
#include "common/wire/tile_codec.hpp"

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

inline wire::TsdTile tile_sample(const LayerKey& key, TileIndex tile, std::uint64_t revision,
                                 const QuantisedTile& cells, const GridGeometry& geometry = {}) {
  wire::TsdTile sample;
  sample.envelope = envelope(key.agent_id.text(), revision);
  sample.layer = {key.agent_id.text(), key.map_id.value, key.floor.value};
  sample.tile_x = tile.x;
  sample.tile_y = tile.y;
  sample.revision = revision;
  sample.payload = wire::encode_tile(cells, geometry);
  return sample;
}

}  // namespace lifeline::test
