#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <Eigen/Core>

#include "common/grid/cell_lanes.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/tile_index.hpp"
#include "common/grid/tsd_cell.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline {

/// A look at some tiles of a map, for loops that must be fast: a rectangle of tile pointers, read
/// in cells counted from the rectangle's lower left corner, so that float is exact enough. Sees
/// changes made to the tiles, not tiles that came or went since assign(). Any map with
/// `find(TileIndex)` and `geometry()` can be looked at.
class TsdView {
 public:
  /// Interpolated signed distance: `value` in [-1, 1] of the truncation distance, `gradient` of the
  /// value per cell, towards the free side.
  struct Sample {
    float value;
    Eigen::Vector2f gradient;
  };

  /// Looks at all tiles within `reach_m` of `centre_map` (and of the map's range), along x and y.
  template <typename Map>
  void assign(const Map& map, const Eigen::Vector2d& centre_map, double reach_m) {
    set_bounds(map.geometry(), centre_map, reach_m);
    for (std::int32_t y = 0; y < rows_; ++y) {
      for (std::int32_t x = 0; x < columns_; ++x) {
        tiles_[slot_of(x, y)] = map.find({first_.x + x, first_.y + y});
      }
    }
  }

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

  /// The pose in cells from the view's corner.
  [[nodiscard]] Pose2 to_view(const Pose2& T_map_x) const {
    const CellIndex corner = first_cell(first_);
    return {T_map_x.x_m / geometry_.cell_size_m - corner.x,
            T_map_x.y_m / geometry_.cell_size_m - corner.y, T_map_x.yaw_rad};
  }
  [[nodiscard]] Eigen::Vector2d to_map(const Eigen::Vector2f& p_view) const {
    const CellIndex corner = first_cell(first_);
    return (p_view.cast<double>() + Eigen::Vector2d(corner.x, corner.y)) * geometry_.cell_size_m;
  }

  /// The tile at this place of the rectangle; nullptr where there is none, and outside.
  [[nodiscard]] const TsdTile* tile(std::int32_t column, std::int32_t row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
    return tiles_[slot_of(column, row)];
  }

  /// The cell, counted from the view's corner.
  [[nodiscard]] TsdCell cell(std::int32_t x, std::int32_t y) const {
    const TsdTile* found = tile(x >> 6, y >> 6);
    return found == nullptr ? TsdCell{} : (*found)[offset_in_tile({x, y})];
  }

  /// Four cells at once, as load_cells() gives them.
  [[nodiscard]] IntLanes four_cells(IntLanes x, IntLanes y) const {
    const IntLanes slots = slots_of(x, y), offsets = ((y & 63) << 6) | (x & 63);
    std::array<TsdCell, 4> cells{};
    for (int k = 0; k < kLanes; ++k) {
      const TsdTile* found = tiles_[static_cast<std::size_t>(slots[k])];
      if (found != nullptr) {
        cells[static_cast<std::size_t>(k)] = (*found)[static_cast<std::size_t>(offsets[k])];
      }
    }
    return std::bit_cast<IntLanes>(cells);
  }

  /// Bilinear between the four cell centres around (x, y), in cells from the view's corner; false
  /// where any of them is unknown.
  [[nodiscard]] bool sample(float x, float y, Sample& into) const {
    const float left = std::floor(x - 0.5F), below = std::floor(y - 0.5F);
    const auto i = static_cast<std::int32_t>(left), j = static_cast<std::int32_t>(below);
    TsdCell c00, c10, c01, c11;
    if ((i & 63) != 63 && (j & 63) != 63) {  // all four in one tile
      const TsdTile* found = tile(i >> 6, j >> 6);
      if (found == nullptr) return false;
      const TsdCell* corner = found->data() + offset_in_tile({i, j});
      c00 = corner[0];
      c10 = corner[1];
      c01 = corner[kTileSide];
      c11 = corner[kTileSide + 1];
    } else {
      c00 = cell(i, j);
      c10 = cell(i + 1, j);
      c01 = cell(i, j + 1);
      c11 = cell(i + 1, j + 1);
    }
    if (!c00.known() || !c10.known() || !c01.known() || !c11.known()) return false;
    const float a = x - 0.5F - left, b = y - 0.5F - below;
    const float v00 = c00.value(), v10 = c10.value(), v01 = c01.value(), v11 = c11.value();
    const float low = v00 + a * (v10 - v00), high = v01 + a * (v11 - v01);
    into.value = low + b * (high - low);
    into.gradient = {(v10 - v00) + b * ((v11 - v01) - (v10 - v00)), high - low};
    return true;
  }

  /// The same at four places at once, to the bit.
  struct FourSamples {
    IntLanes known;  ///< all bits set where sample() is true; the rest tells nothing elsewhere
    FloatLanes value, gradient_x, gradient_y;
  };
  [[nodiscard]] FourSamples sample_four(FloatLanes x, FloatLanes y) const {
    const IntLanes i = floor_of(x - 0.5F), j = floor_of(y - 0.5F);
    const IntLanes slots = slots_of(i, j), offsets = ((j & 63) << 6) | (i & 63);
    const IntLanes between_tiles = ((i & 63) == 63) | ((j & 63) == 63);
    std::array<FloatLanes, 4> corners{};  // of one place each: c00, c10, c01, c11, as bits
    for (int k = 0; k < kLanes; ++k) {
      FloatLanes& of_place = corners[static_cast<std::size_t>(k)];
      if (between_tiles[k] != 0) {
        of_place = std::bit_cast<FloatLanes>(cells_between(i[k], j[k]));
      } else if (const TsdTile* found = tiles_[static_cast<std::size_t>(slots[k])]) {
        std::array<TsdCell, 4> cells;
        const TsdCell* corner = found->data() + offsets[k];
        std::memcpy(cells.data(), corner, 2 * sizeof(TsdCell));
        std::memcpy(cells.data() + 2, corner + kTileSide, 2 * sizeof(TsdCell));
        of_place = std::bit_cast<FloatLanes>(cells);
      }
    }
    transpose(corners);  // now each is one corner of all four places
    IntLanes known = IntLanes{} - 1;
    std::array<FloatLanes, 4> v;
    for (std::size_t corner = 0; corner < v.size(); ++corner) {
      const auto cells = std::bit_cast<IntLanes>(corners[corner]);
      known &= cells > kTsdBits;
      v[corner] = values_of(cells);
    }
    const FloatLanes a = x - 0.5F - __builtin_convertvector(i, FloatLanes);
    const FloatLanes b = y - 0.5F - __builtin_convertvector(j, FloatLanes);
    const auto& [v00, v10, v01, v11] = v;
    const FloatLanes low = v00 + a * (v10 - v00), high = v01 + a * (v11 - v01);
    return {known, low + b * (high - low), (v10 - v00) + b * ((v11 - v01) - (v10 - v00)),
            high - low};
  }

 private:
  /// The cells (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1), wherever they are.
  [[nodiscard]] IntLanes cells_between(std::int32_t i, std::int32_t j) const {
    const std::array<TsdCell, 4> cells{cell(i, j), cell(i + 1, j), cell(i, j + 1),
                                       cell(i + 1, j + 1)};
    return std::bit_cast<IntLanes>(cells);
  }

  [[nodiscard]] std::size_t slot_of(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>((row << column_bits_) | column);
  }
  /// Of the tiles of four cells; outside of the rectangle the one that holds none.
  [[nodiscard]] IntLanes slots_of(IntLanes x, IntLanes y) const {
    const IntLanes column = x >> 6, row = y >> 6;
    const IntLanes outside = (column < 0) | (row < 0) | (column >= columns_) | (row >= rows_);
    return choose(outside, IntLanes{} + (rows_ << column_bits_), (row << column_bits_) | column);
  }

  void set_bounds(const GridGeometry& geometry, const Eigen::Vector2d& centre_map, double reach_m) {
    geometry_ = geometry;
    const double tile_m = geometry.cell_size_m * kTileSide;
    const auto index = [&](double at_m) {
      return static_cast<std::int32_t>(std::clamp(std::floor(at_m / tile_m),
                                                  -static_cast<double>(kMaxTileIndex),
                                                  static_cast<double>(kMaxTileIndex - 1)));
    };
    first_ = {index(centre_map.x() - reach_m), index(centre_map.y() - reach_m)};
    columns_ = index(centre_map.x() + reach_m) - first_.x + 1;
    rows_ = index(centre_map.y() + reach_m) - first_.y + 1;
    column_bits_ = std::bit_width(static_cast<std::uint32_t>(columns_));
    tiles_.assign((static_cast<std::size_t>(rows_) << column_bits_) + 1, nullptr);
  }

  GridGeometry geometry_;
  TileIndex first_{};
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  int column_bits_ = 0;                         ///< rows of tiles are 2^column_bits_ apart
  std::vector<const TsdTile*> tiles_{nullptr};  ///< row by row, and one that there is not
};

}  // namespace lifeline
