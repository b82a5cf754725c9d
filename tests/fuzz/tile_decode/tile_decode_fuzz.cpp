// Any bytes as a tile from the radio: refused, or a valid tile that survives being sent on. The
// first byte, modulo 3, chooses: 0, the rest is a payload; 1, the rest is compressed first, so that
// the fuzzer gets past the frame and its checksum; 2, the rest is the code of coarse cells.

#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <zstd.h>

#include "common/wire/coarse_cells.hpp"
#include "common/wire/coarse_tile.hpp"
#include "common/wire/tile_codec.hpp"

namespace {

const lifeline::GridGeometry kGeometry{.cell_size_m = 0.05, .truncation_m = 0.15};

void require(bool condition) {
  if (!condition) std::abort();
}

std::vector<std::uint8_t> compressed(std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> frame(ZSTD_compressBound(content.size()));
  frame.resize(ZSTD_compress(frame.data(), frame.size(), content.data(), content.size(), 1));
  return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lifeline::QuantisedCell;
  if (size == 0) return 0;
  const std::span<const std::uint8_t> rest(data + 1, size - 1);
  if (data[0] % 3 == 2) {  // the code of coarse cells, behind its checksum
    const auto cells = lifeline::wire::decode_cells(rest);
    require(lifeline::wire::is_coarse(cells));
    require(lifeline::wire::decode_cells(lifeline::wire::encode_cells(cells)) == cells);
    return 0;
  }
  const auto tile = data[0] % 3 == 0 ? lifeline::wire::decode_tile(rest, kGeometry)
                                     : lifeline::wire::decode_tile(compressed(rest), kGeometry);
  if (!tile) {
    require(!tile.error().text.empty() && tile.error().text.find('\n') == std::string::npos);
    return 0;
  }
  for (const QuantisedCell cell : *tile) {
    require(cell.weight <= QuantisedCell::kMaxWeight && cell.tsd >= -QuantisedCell::kTsdOne);
    require(cell.weight != 0 || cell.tsd == 0);
  }
  const auto again =
      lifeline::wire::decode_tile(lifeline::wire::encode_tile(*tile, kGeometry), kGeometry);
  require(again.has_value() && *again == *tile);
  return 0;
}
