#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "common/base/ids.hpp"
#include "common/grid/tile_index.hpp"
#include "common/grid/tsd_cell.hpp"

namespace lifeline::sharing {

/// A tile as it was published, as it is kept through a restart.
struct KeptTile {
  Revision revision;
  std::vector<std::uint8_t> payload;  ///< as it was published; empty for tiles of others
  std::shared_ptr<const QuantisedTile> cells;
};

using KeptTiles = std::map<TileIndex, KeptTile>;
using KeptLayers = std::map<LayerKey, KeptTiles>;

}  // namespace lifeline::sharing
