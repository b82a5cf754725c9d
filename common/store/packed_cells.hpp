#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/grid/tsd_cell.hpp"

namespace lifeline::store {

/// Cells of a tile as one zstd frame: all distances, then all weights, little-endian. Made for the
/// disk: no loss, a tenth of a millisecond, not the smallest.
[[nodiscard]] std::string pack_cells(const TsdTile& tile);
[[nodiscard]] std::string pack_cells(const QuantisedTile& tile);

/// The cells of a frame; empty where it is none of pack_cells' or holds values that no cell has.
/// Takes no more memory than a tile needs, whatever the frame claims.
[[nodiscard]] std::optional<TsdTile> unpack_layer_cells(std::string_view frame);
[[nodiscard]] std::optional<QuantisedTile> unpack_published_cells(std::string_view frame);

}  // namespace lifeline::store
