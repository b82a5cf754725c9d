#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/grid/tsd_cell.hpp"

namespace lifeline::wire {

/// A coarse tile (a bug otherwise) as arithmetic code, by the model of idl/tile.proto.
[[nodiscard]] std::vector<std::uint8_t> encode_cells(const QuantisedTile& tile);

/// The coarse tile that the octets stand for: any octets stand for one.
[[nodiscard]] QuantisedTile decode_cells(std::span<const std::uint8_t> octets);

}  // namespace lifeline::wire
