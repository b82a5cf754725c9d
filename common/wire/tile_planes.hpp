#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.hpp"
#include "common/grid/tsd_cell.hpp"

namespace lifeline::wire {

/// A tile taken apart into the planes of idl/tile.proto, where it is written down octet by octet:
/// mostly zeros, so that they compress well.
struct TilePlanes {
  static constexpr std::size_t kWeightOctets = kTileCells / 2;
  static constexpr std::size_t kFreeOctets = kTileCells / 8;

  std::vector<std::uint8_t> weights;  ///< kWeightOctets
  std::vector<std::uint8_t> free;     ///< kFreeOctets
  std::vector<std::uint8_t> tsd;      ///< one octet for each known cell that is not free
};

/// Every cell must be valid: weight and tsd within the published limits, tsd 0 where unknown.
[[nodiscard]] TilePlanes to_planes(const QuantisedTile& tile);

/// The tile again, bit for bit. bad_data where a plane has another length than it must have, where
/// a free cell is unknown, or where an octet stands for no value.
[[nodiscard]] Result<QuantisedTile> from_planes(std::span<const std::uint8_t> weights,
                                                std::span<const std::uint8_t> free,
                                                std::span<const std::uint8_t> tsd);

}  // namespace lifeline::wire
