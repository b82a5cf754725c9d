#pragma once

#include <cstdint>
#include <vector>

#include "common/base/ids.hpp"
#include "common/grid/tsd_cell.hpp"
#include "common/grid/tsd_grid.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// A tile at a revision as it travels: one sample a part, envelopes still empty.
[[nodiscard]] std::vector<wire::TsdTile> tile_samples(const LayerKey& layer, TileIndex tile,
                                                      Revision revision, const QuantisedTile& cells,
                                                      const GridGeometry& geometry);
/// The same of a payload that was encoded before.
[[nodiscard]] std::vector<wire::TsdTile> tile_samples(const LayerKey& layer, TileIndex tile,
                                                      Revision revision,
                                                      const std::vector<std::uint8_t>& payload);

}  // namespace lifeline::sharing
