// Any bytes as a tile from the radio: refused, or a valid tile that survives being sent on. The
// first byte chooses: even, the rest is a payload; odd, the rest is compressed first, so that the
// fuzzer gets past the frame and its checksum.

#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <zstd.h>

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
  const auto tile = data[0] % 2 == 0 ? lifeline::wire::decode_tile(rest, kGeometry)
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
