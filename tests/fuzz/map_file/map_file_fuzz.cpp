// Any bytes as a saved map: refused in one line, or a map that can be saved and is then the same.

#include <cstdint>
#include <cstdlib>

#include "common/files/map_file.hpp"
#include "tests/support/memory_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lifeline;
  static const support::TemporaryFolder folder;
  const test::MemoryFile file({data, size});
  const auto map = files::load_map(file.path());
  if (!map) {
    require(map.error().text.find('\n') == std::string::npos);
    return 0;
  }
  for (const auto& [stamp, pose] : map->trajectory) require(pose.is_finite());
  const auto copy = folder.path() / "copy.lifemap";
  require(files::save_map(copy, map->layer, map->grid, map->trajectory).has_value());
  const auto again = files::load_map(copy);
  require(again.has_value() && again->layer == map->layer);
  require(again->grid.tiles() == map->grid.tiles());
  for (const TileIndex tile : map->grid.tiles()) {
    require(*again->grid.find(tile) == *map->grid.find(tile));
  }
  return 0;
}
