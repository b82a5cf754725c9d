#include "common/sharing/tile_samples.hpp"

#include "common/sharing/accept.hpp"
#include "common/wire/tile_codec.hpp"
#include "common/wire/tile_parts.hpp"

namespace lifeline::sharing {

std::vector<wire::TsdTile> tile_samples(const LayerKey& layer, TileIndex tile, Revision revision,
                                        const QuantisedTile& cells, const GridGeometry& geometry) {
  return tile_samples(layer, tile, revision, wire::encode_tile(cells, geometry));
}

std::vector<wire::TsdTile> tile_samples(const LayerKey& layer, TileIndex tile, Revision revision,
                                        const std::vector<std::uint8_t>& payload) {
  auto parts = wire::split_payload(payload);
  wire::TsdTile sample;
  sample.layer = to_layer_name(layer);
  sample.tile_x = tile.x;
  sample.tile_y = tile.y;
  sample.revision = revision.value;
  sample.parts = static_cast<std::uint8_t>(parts.size());
  std::vector<wire::TsdTile> samples(parts.size(), sample);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    samples[part].part = static_cast<std::uint8_t>(part);
    samples[part].payload = std::move(parts[part]);
  }
  return samples;
}

}  // namespace lifeline::sharing
