#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/working_map.hpp"

namespace lifeline::slam {

struct FitFieldConfig {
  double spacing_m = 0.1;  ///< of the field; doubled until all of the map fits max_cells
  std::size_t max_cells = std::size_t{1} << 21U;
};

/// How well a scan's points would fit everywhere in a map, on a lattice of places: for each place,
/// and for the best of each block of 2 x 2, 4 x 4 and 8 x 8 places.
class FitField {
 public:
  /// Fit of a point on a surface; 0 in the unknown, below 0 in free space. The sum over 255 points
  /// fits 16 bits many times over.
  static constexpr int kFull = 10;
  static constexpr int kLevels = 4;  ///< blocks of 1, 2, 4, 8 places a side
  static constexpr int kBlock = 1 << (kLevels - 1);

  struct Place {
    std::int32_t column, row;
  };

  void assign(const WorkingMap& map, const FitFieldConfig& config);
  void clear();
  [[nodiscard]] bool empty() const { return fit_[0].empty(); }

  [[nodiscard]] double spacing_m() const { return spacing_m_; }
  /// The middle of a place, in the map.
  [[nodiscard]] Eigen::Vector2d centre_of(Place place) const {
    return origin_m_ + spacing_m_ * Eigen::Vector2d(place.column + 0.5, place.row + 0.5);
  }
  [[nodiscard]] bool contains(Place place) const {
    return place.column >= 0 && place.row >= 0 && place.column < columns_ && place.row < rows_;
  }
  /// The best fit in the block of a level whose lower left corner is at `place`, within the field.
  [[nodiscard]] int fit(int level, Place place) const {
    return fit_[static_cast<std::size_t>(level)][at(place)];
  }
  /// Whether a head may stand here: in known free space.
  [[nodiscard]] bool is_free(Place place) const { return free_[at(place)] != 0; }

  /// Sums the fits of points `offsets` away from a head anywhere in each block of the last level:
  /// no head in it scores more. Tells nothing of blocks without a free place.
  void bound_blocks(std::span<const Place> offsets, std::vector<std::int16_t>& sums) const;
  [[nodiscard]] bool has_free_place(std::size_t block) const { return free_blocks_[block] != 0; }
  /// The lower left corner of a block.
  [[nodiscard]] Place corner_of(std::size_t block) const {
    const auto number = static_cast<std::int32_t>(block);
    return {number % block_stride_ * kBlock, number / block_stride_ * kBlock};
  }

 private:
  /// Of a row of blocks: [first, end).
  struct Run {
    std::int32_t first, end;
  };
  void lay_out(const WorkingMap& map, const FitFieldConfig& config);
  void fill_fit(const WorkingMap& map);
  void fill_tile(const TsdTile& cells, const GridGeometry& geometry, Eigen::Vector2d corner_m);
  void build_level(int level);
  void build_phases();
  [[nodiscard]] std::size_t at(Place place) const {
    return static_cast<std::size_t>(place.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(place.column);
  }

  double spacing_m_ = 0.1;
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  std::int32_t columns_ = 0, rows_ = 0;  ///< multiples of kBlock
  /// Of each level, the best fit within the block whose lower left corner is here.
  std::array<std::vector<std::int8_t>, kLevels> fit_;
  std::vector<std::int8_t> phases_;        ///< the last level, by (row, column) modulo kBlock
  std::vector<std::uint8_t> free_;         ///< whether a head may stand here ...
  std::vector<std::uint8_t> free_blocks_;  ///< ... or anywhere in this block
  std::int32_t block_stride_ = 0;          ///< from one row of blocks to the next, in both
  std::vector<Run> free_runs_;             ///< of each row: the blocks with a free place
};

}  // namespace lifeline::slam
