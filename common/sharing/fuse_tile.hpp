#pragma once

#include <cstdint>
#include <vector>

#include "common/sharing/replica_store.hpp"

namespace lifeline::sharing {

/// A cell of a fused map: as QuantisedCell, but its weight may reach 255.
struct FusedCell {
  std::int8_t tsd = 0;
  std::uint8_t weight = 0;  ///< 0 = unknown, and then tsd is 0
  bool operator==(const FusedCell&) const = default;
};

using FusedTile = std::array<FusedCell, kTileCells>;

/// One layer and where it lies in the map that is fused.
struct FusedMember {
  const ReplicaLayer* layer;
  wire::FixedTransform T_fused_layer;
};

/// Fuses one tile of the common map out of the members' layers: for each cell the mean of the
/// members' bilinearly interpolated signed distances, weighted by their cells' weights. A member
/// knows a cell where it knows its nearest own cell.
///
/// Integers throughout, members in the given order, no library function: the same inputs give the
/// same bits on every machine. False when no member knows any cell; `tile` is then all unknown.
[[nodiscard]] bool fuse_tile(TileIndex index, const std::vector<FusedMember>& members,
                             std::int64_t cell_size_um, FusedTile& tile);

/// The tiles of the fused map on which a change of `layer_tile` may show.
[[nodiscard]] std::vector<TileIndex> tiles_touched(TileIndex layer_tile,
                                                   const wire::FixedTransform& T_fused_layer,
                                                   std::int64_t cell_size_um);

}  // namespace lifeline::sharing
