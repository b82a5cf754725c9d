#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "common/grid/tile_index.hpp"
#include "common/sharing/fuse_tile.hpp"

namespace lifeline::dashboard {

/// A tile of a map, or that it is gone (no cells).
struct TileChange {
  std::string map;  ///< "" is the common map
  TileIndex tile;
  std::shared_ptr<const sharing::FusedTile> cells;
};

/// All tiles of all maps as they stand, in the order in which they last changed, so that a reader
/// who remembers one number gets what is new and each tile once, however slow it is. One owner, not
/// thread-safe.
class TileBook {
 public:
  using Version = std::uint64_t;

  void put(TileChange change);
  /// A map that is no more.
  void forget(const std::string& map) { maps_.erase(map); }

  /// Packs tiles that changed after `seen` into a `Tiles` frame of about `octets`, and moves `seen`
  /// on. `from_start` where `seen` is 0. Empty where there is nothing to say (an empty map is said
  /// once).
  [[nodiscard]] std::shared_ptr<const std::string> next_frame(const std::string& map, Version& seen,
                                                              std::size_t octets);

 private:
  struct Entry {
    Version version = 0;
    std::shared_ptr<const sharing::FusedTile> cells;  ///< until packed
    std::string packed;
    bool is_packed = false;
  };
  struct Map {
    std::map<TileIndex, Entry> tiles;
    std::map<Version, TileIndex> changes;
  };
  std::map<std::string, Map> maps_;
  Version last_ = 1;  // 0 and 1 are those of readers who have nothing, and of nothing
};

/// A tile as the page takes it: a zstd frame of two planes.
[[nodiscard]] std::string pack_tile(const sharing::FusedTile& cells);

}  // namespace lifeline::dashboard
