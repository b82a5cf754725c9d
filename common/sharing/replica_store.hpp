#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/grid/tsd_grid.hpp"
#include "common/wire/messages.hpp"
#include "common/wire/tile_parts.hpp"

namespace lifeline::sharing {

/// A tile of somebody's layer as it was published.
struct ReplicaTile {
  Revision revision;
  std::shared_ptr<const QuantisedTile> cells;
};

using ReplicaLayer = std::map<TileIndex, ReplicaTile>;
using RevisionDigest = std::array<std::uint8_t, 16>;

enum class Applied {
  newer,     ///< the sample replaced what was held
  repeated,  ///< the same revision again: nothing changed
  older,     ///< refused: a newer revision is held
  part,      ///< kept until the revision's other parts are there
};

/// Every helmet's layer as published, the own one included, each apart from the others
/// (docs/architecture.md, rules 1-3). Order of arrival does not matter, repeats change nothing. One
/// owner, not thread-safe.
class ReplicaStore {
 public:
  static constexpr std::size_t kMaxLayers = 64;
  static constexpr std::size_t kMaxTilesPerLayer = 16384;
  static constexpr std::size_t kMaxIncompleteTiles = 4096;  ///< of all layers together

  struct ChangedTile {
    LayerKey layer;
    TileIndex tile;
  };

  explicit ReplicaStore(GridGeometry geometry) : geometry_(geometry) {}

  /// Takes in a part of a tile whose envelope was accepted. An error (undecodable payload, other
  /// cell size, tile out of range, somebody else's layer, too many layers, tiles or incomplete
  /// tiles) changes nothing that is held.
  [[nodiscard]] Result<Applied> apply(const wire::TsdTile& sample);
  /// The same for a tile that anybody sent again.
  [[nodiscard]] Result<Applied> apply(const wire::TileCopy& copy);

  /// Holds a tile again that was held before a restart, unless a newer one came meanwhile. What
  /// apply() would refuse is refused.
  [[nodiscard]] Result<void> restore(const LayerKey& layer, TileIndex tile, ReplicaTile held);

  /// Hears of each tile taken in by apply(), to keep it.
  using Listener = std::function<void(const LayerKey&, TileIndex, const ReplicaTile&)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  /// Holds a tile just published by ourselves.
  void put_own(const LayerKey& layer, TileIndex tile, Revision revision,
               std::shared_ptr<const QuantisedTile> cells);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::map<LayerKey, ReplicaLayer>& layers() const { return layers_; }
  /// nullptr where nothing is held.
  [[nodiscard]] const ReplicaLayer* find(const LayerKey& layer) const;
  [[nodiscard]] const ReplicaTile* find(const LayerKey& layer, TileIndex tile) const;

  /// What changed since the last call, each tile once for each change.
  [[nodiscard]] std::vector<ChangedTile> take_changed();

  /// First 16 octets of the SHA-256 of a layer's (tile, revision) pairs: equal exactly where the
  /// revision vectors are.
  [[nodiscard]] RevisionDigest digest(const LayerKey& layer) const;

 private:
  [[nodiscard]] Result<Applied> take_in(const wire::TsdTile& sample);
  [[nodiscard]] Result<void> check_limits(const LayerKey& layer, TileIndex tile) const;
  /// The tile once all of its parts are there.
  [[nodiscard]] Result<std::optional<QuantisedTile>> join(const ChangedTile& tile,
                                                          const wire::TsdTile& sample);

  GridGeometry geometry_;
  std::map<LayerKey, ReplicaLayer> layers_;
  std::map<std::pair<LayerKey, TileIndex>, wire::TileParts> incomplete_;
  std::vector<ChangedTile> changed_;
  Listener listener_;
};

/// What two machines must have alike to hold the same common map: the directive's epoch and all
/// members' revision vectors. `members` in the directive's order.
[[nodiscard]] RevisionDigest fingerprint(Epoch epoch, const std::vector<LayerKey>& members,
                                         const ReplicaStore& store);

/// A replica as a TSD grid, for matching and pictures.
[[nodiscard]] TsdGrid to_grid(const ReplicaLayer& layer, const GridGeometry& geometry);

}  // namespace lifeline::sharing
