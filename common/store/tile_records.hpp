#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/grid/tsd_grid.hpp"
#include "common/sharing/kept_layers.hpp"
#include "common/store/record_file.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::store {

/// "PREFIX/X/Y".
[[nodiscard]] std::string tile_key(std::string_view prefix, TileIndex tile);
/// The tile of such a key; empty where it is none.
[[nodiscard]] std::optional<TileIndex> tile_of_key(std::string_view key, std::string_view prefix);
/// "tile/AGENT/MAP/FLOOR/X/Y".
[[nodiscard]] std::string published_key(const LayerKey& layer, TileIndex tile);

/// The content of a record of a tile of our own: the very payload that goes over the air.
[[nodiscard]] std::string own_tile_record(Revision revision,
                                          const std::vector<std::uint8_t>& payload);
/// The same of somebody else's tile.
[[nodiscard]] std::string peer_tile_record(Revision revision, const QuantisedTile& cells);

/// All tiles among the records. bad_data where one cannot be read: then none of the records is to
/// be relied on.
[[nodiscard]] Result<sharing::KeptLayers> read_tiles(const Records& records,
                                                     const GridGeometry& geometry);

inline constexpr const char* kDirectiveKey = "directive";
[[nodiscard]] std::string directive_record(const wire::MergeDirective& directive);
/// The directive among the records, its envelope empty; nothing where there is none. Checked as one
/// that comes from outside.
[[nodiscard]] Result<std::optional<wire::MergeDirective>> read_directive(
    const Records& records, const std::string& mission_id);

}  // namespace lifeline::store
