#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.hpp"
#include "common/grid/tsd_cell.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::wire {

/// A length as files and payloads hold it: whole micrometres, so that two machines compare it
/// exactly.
[[nodiscard]] std::uint32_t to_micrometres(double length_m);

/// A tile as payload: a TilePayload of idl/tile.proto in one zstd frame, never more than
/// kMaxTilePayload octets. Equal tiles give equal octets. Every cell must be valid (see
/// QuantisedCell).
[[nodiscard]] std::vector<std::uint8_t> encode_tile(const QuantisedTile& tile,
                                                    const GridGeometry& geometry);

/// The tile in a payload from outside. Refuses (bad_data) whatever encode_tile does not write,
/// without allocating more than a tile needs, and (unsupported) other encoding versions and maps
/// of other cell size or truncation than `expected`.
[[nodiscard]] Result<QuantisedTile> decode_tile(std::span<const std::uint8_t> payload,
                                                const GridGeometry& expected);

}  // namespace lifeline::wire
