#include "common/store/packed_cells.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>

#include <zstd.h>

#include "common/base/check.hpp"

namespace lifeline::store {
namespace {

constexpr int kLevel = 1;
constexpr std::size_t kLayerOctets = 4 * kTileCells;
constexpr std::size_t kPublishedOctets = 2 * kTileCells;

std::string compress(const char* octets, std::size_t size) {
  std::string frame(ZSTD_compressBound(size), '\0');
  const std::size_t packed = ZSTD_compress(frame.data(), frame.size(), octets, size, kLevel);
  LIFELINE_CHECK(ZSTD_isError(packed) == 0);
  frame.resize(packed);
  return frame;
}

template <std::size_t kSize>
bool decompress(std::string_view frame, std::array<std::uint8_t, kSize>& octets) {
  if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != kSize) return false;
  return ZSTD_decompress(octets.data(), kSize, frame.data(), frame.size()) == kSize;
}

void put_16(std::uint16_t value, std::uint8_t* at) {
  at[0] = static_cast<std::uint8_t>(value & 0xffU);
  at[1] = static_cast<std::uint8_t>(value >> 8U);
}

std::uint16_t get_16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] | (at[1] << 8U));
}

}  // namespace

std::string pack_cells(const TsdTile& tile) {
  std::array<std::uint8_t, kLayerOctets> octets;
  for (std::size_t i = 0; i < kTileCells; ++i) {
    put_16(static_cast<std::uint16_t>(tile[i].tsd), &octets[2 * i]);
    put_16(tile[i].weight, &octets[2 * (kTileCells + i)]);
  }
  return compress(reinterpret_cast<const char*>(octets.data()), octets.size());
}

std::string pack_cells(const QuantisedTile& tile) {
  std::array<std::uint8_t, kPublishedOctets> octets;
  for (std::size_t i = 0; i < kTileCells; ++i) {
    octets[i] = static_cast<std::uint8_t>(tile[i].tsd);
    octets[kTileCells + i] = tile[i].weight;
  }
  return compress(reinterpret_cast<const char*>(octets.data()), octets.size());
}

std::optional<TsdTile> unpack_layer_cells(std::string_view frame) {
  std::array<std::uint8_t, kLayerOctets> octets;
  if (!decompress(frame, octets)) return std::nullopt;
  TsdTile tile;
  for (std::size_t i = 0; i < kTileCells; ++i) {
    tile[i].tsd = static_cast<std::int16_t>(get_16(&octets[2 * i]));
    tile[i].weight = get_16(&octets[2 * (kTileCells + i)]);
    if (std::abs(int{tile[i].tsd}) > TsdCell::kTsdOne) return std::nullopt;
    if (tile[i].weight == 0 && tile[i].tsd != 0) return std::nullopt;
  }
  return tile;
}

std::optional<QuantisedTile> unpack_published_cells(std::string_view frame) {
  std::array<std::uint8_t, kPublishedOctets> octets;
  if (!decompress(frame, octets)) return std::nullopt;
  QuantisedTile tile;
  for (std::size_t i = 0; i < kTileCells; ++i) {
    tile[i].tsd = static_cast<std::int8_t>(octets[i]);
    tile[i].weight = octets[kTileCells + i];
    if (std::abs(int{tile[i].tsd}) > QuantisedCell::kTsdOne) return std::nullopt;
    if (tile[i].weight > QuantisedCell::kMaxWeight) return std::nullopt;
    if (tile[i].weight == 0 && tile[i].tsd != 0) return std::nullopt;
  }
  return tile;
}

}  // namespace lifeline::store
