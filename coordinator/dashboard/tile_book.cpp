#include "coordinator/dashboard/tile_book.hpp"

#include <array>

#include "coordinator/dashboard/zstd_frame.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {

std::string pack_tile(const sharing::FusedTile& cells) {
  std::array<char, 2 * kTileCells> planes;
  for (std::size_t i = 0; i < kTileCells; ++i) {
    planes[i] = static_cast<char>(cells[i].tsd);
    planes[kTileCells + i] = static_cast<char>(cells[i].weight);
  }
  return to_zstd({planes.data(), planes.size()});
}

void TileBook::put(TileChange change) {
  Map& map = maps_[change.map];
  const auto [at, is_new] = map.tiles.try_emplace(change.tile);
  Entry& entry = at->second;
  if (!is_new) map.changes.erase(entry.version);
  entry = {++last_, std::move(change.cells), {}, false};
  map.changes.emplace(last_, change.tile);
}

std::shared_ptr<const std::string> TileBook::next_frame(const std::string& name, Version& seen,
                                                        std::size_t octets) {
  static Map nothing;
  const bool from_start = seen == 0;
  const auto found = maps_.find(name);
  Map& map = found == maps_.end() ? nothing : found->second;  // clients may name what is not there
  auto next = map.changes.upper_bound(seen);
  if (next == map.changes.end() && !from_start) return nullptr;
  proto::dashboard::ServerFrame frame;
  auto& tiles = *frame.mutable_tiles();
  tiles.set_map(name);
  tiles.set_from_start(from_start);
  seen = std::max<Version>(seen, 1);
  for (std::size_t size = 0; next != map.changes.end() && size < octets; ++next) {
    Entry& entry = map.tiles.at(next->second);
    if (!entry.is_packed) {
      if (entry.cells) entry.packed = pack_tile(*entry.cells);
      entry.cells.reset();
      entry.is_packed = true;
    }
    seen = next->first;
    if (from_start && entry.packed.empty()) continue;
    auto& tile = *tiles.add_tiles();
    tile.set_x(next->second.x);
    tile.set_y(next->second.y);
    tile.set_cells(entry.packed);
    size += entry.packed.size() + 16;
  }
  tiles.set_is_complete(next == map.changes.end());
  return std::make_shared<const std::string>(frame.SerializeAsString());
}

}  // namespace lifeline::dashboard
