#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace lifeline {

/// Cells along one side of a tile.
inline constexpr int kTileSide = 64;
inline constexpr int kTileCells = kTileSide * kTileSide;
/// Tiles further than this from the origin do not exist (+-1638 m at 0.05 m): what comes from
/// outside is checked against it.
inline constexpr std::int32_t kMaxTileIndex = 512;

/// A cell of an unbounded grid; cell (0, 0) spans [0, cell size) in x and y.
struct CellIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  auto operator<=>(const CellIndex&) const = default;
};

/// A tile of an unbounded grid; tile (0, 0) holds the cells (0, 0) ... (63, 63). Ordered by x, then
/// y.
struct TileIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  auto operator<=>(const TileIndex&) const = default;
};

[[nodiscard]] constexpr TileIndex tile_of(CellIndex cell) {
  return {cell.x >> 6, cell.y >> 6};  // arithmetic shift: floor division, for negative indices too
}

/// Position of a cell within its tile, row by row: y * 64 + x.
[[nodiscard]] constexpr std::size_t offset_in_tile(CellIndex cell) {
  return static_cast<std::size_t>(((cell.y & 63) << 6) | (cell.x & 63));
}

[[nodiscard]] constexpr CellIndex first_cell(TileIndex tile) {
  return {tile.x * kTileSide, tile.y * kTileSide};
}

[[nodiscard]] constexpr bool is_in_range(TileIndex tile) {
  return tile.x >= -kMaxTileIndex && tile.x < kMaxTileIndex && tile.y >= -kMaxTileIndex &&
         tile.y < kMaxTileIndex;
}

static_assert(kTileSide == 64, "tile_of and offset_in_tile shift by 6");

}  // namespace lifeline

template <>
struct std::hash<lifeline::TileIndex> {
  std::size_t operator()(const lifeline::TileIndex& tile) const noexcept {
    const auto x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile.x));
    const auto y = static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile.y));
    return static_cast<std::size_t>(((x << 32U) | y) * 0x9E3779B97F4A7C15ULL);
  }
};
