#include "tests/bench/codec/rivals.hpp"

#include <array>
#include <cstdint>

#include <lz4hc.h>
#include <png.h>
#include <zstd.h>

#include "common/base/check.hpp"

namespace lifeline::bench {
namespace {

using Plane = std::array<std::uint8_t, kTileCells>;

Plane plane_of(const QuantisedTile& tile) {
  Plane plane{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    plane[i] = static_cast<std::uint8_t>(tile[i].weight == 0 ? -128 : tile[i].tsd);
  }
  return plane;
}

std::size_t zstd_octets(const QuantisedTile& tile) {
  const Plane plane = plane_of(tile);
  std::vector<char> room(ZSTD_compressBound(plane.size()));
  const std::size_t size = ZSTD_compress(room.data(), room.size(), plane.data(), plane.size(), 19);
  LIFELINE_CHECK(ZSTD_isError(size) == 0);
  return size;
}

std::size_t lz4_octets(const QuantisedTile& tile) {
  const Plane plane = plane_of(tile);
  std::vector<char> room(static_cast<std::size_t>(LZ4_compressBound(kTileCells)));
  const int size = LZ4_compress_HC(reinterpret_cast<const char*>(plane.data()), room.data(),
                                   kTileCells, static_cast<int>(room.size()), LZ4HC_CLEVEL_MAX);
  LIFELINE_CHECK(size > 0);
  return static_cast<std::size_t>(size);
}

std::size_t png_octets(const QuantisedTile& tile) {
  const Plane plane = plane_of(tile);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  LIFELINE_CHECK(png != nullptr);
  png_infop info = png_create_info_struct(png);
  std::size_t size = 0;
  png_set_write_fn(
      png, &size,
      [](png_structp to, png_bytep, png_size_t count) {
        *static_cast<std::size_t*>(png_get_io_ptr(to)) += count;
      },
      nullptr);
  png_set_compression_level(png, 9);
  png_set_filter(png, 0, PNG_ALL_FILTERS);
  png_set_IHDR(png, info, kTileSide, kTileSide, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::size_t row = 0; row < kTileSide; ++row) {
    png_write_row(png, plane.data() + row * kTileSide);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return size;
}

}  // namespace

const std::vector<Rival>& rivals() {
  static const std::vector<Rival> all = {
      {"zstd -19 of the distances", zstd_octets},
      {"lz4 of the distances", lz4_octets},
      {"PNG of the distances", png_octets},
  };
  return all;
}

}  // namespace lifeline::bench
