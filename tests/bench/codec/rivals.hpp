#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/grid/tsd_cell.hpp"

namespace lifeline::bench {

/// A general-purpose compressor that a tile could be given to.
struct Rival {
  std::string name;
  /// Octets of the tile's distances, one octet a cell, unknown as -128; weights are left out.
  std::size_t (*octets)(const QuantisedTile& tile);
};

/// zstd -19, lz4 at its strongest, PNG at its strongest.
[[nodiscard]] const std::vector<Rival>& rivals();

}  // namespace lifeline::bench
