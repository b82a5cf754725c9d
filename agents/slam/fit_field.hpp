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

/// Work that may still be done, in steps of about a nanosecond each; whatever works takes from it.
/// Counted, not timed: the same input gives the same output.
using SearchWork = std::int64_t;

/// How well a scan's points would fit everywhere in a map, on a lattice of places: for each place,
/// and for the best of each block of 2 x 2, 4 x 4 and 8 x 8 places.
class FitField {
 public:
  /// Fit of a point on a surface; 0 in the unknown, below 0 in free space. The sum over 255 points
  /// fits 16 bits many times over.
  static constexpr int kFull = 10;
  static constexpr int kLevels = 4;  ///< blocks of 1, 2, 4, 8 places a side
  static constexpr int kBlock = 1 << (kLevels - 1);
  /// Points further from the head than this many places, along x or y, take no part.
  static constexpr std::int32_t kReach = 32 * kBlock - 1;

  /// Blocks that are bounded at a time.
  static constexpr std::int32_t kAtOnce = 64;

  struct Place {
    std::int32_t column, row;
    bool operator==(const Place&) const = default;
  };
  /// A rectangle of blocks: columns [left, right) of the rows [low, high).
  struct Blocks {
    std::int32_t left, low, right, high;
  };
  /// A block, and the most that any head in it may score.
  struct BlockBound {
    std::int32_t block;
    std::int16_t bound;
  };

  /// Begins to take a map; advance() does it.
  void begin(const WorkingMap& map, const FitFieldConfig& config);
  /// Goes on until all of the map is taken or no work is left. Whether all is: only then can the
  /// field be asked. What changes in the map meanwhile is taken or not.
  [[nodiscard]] bool advance(const WorkingMap& map, SearchWork& work);
  void clear();
  [[nodiscard]] bool empty() const { return columns_ == 0; }

  [[nodiscard]] double spacing_m() const { return spacing_m_; }
  /// The middle of a place, in the map.
  [[nodiscard]] Eigen::Vector2d centre_of(Place place) const {
    return origin_m_ + spacing_m_ * Eigen::Vector2d(place.column + 0.5, place.row + 0.5);
  }
  [[nodiscard]] bool contains(Place place) const {
    return place.column >= 0 && place.row >= 0 && place.column < columns_ && place.row < rows_;
  }
  /// The best fit in the block of a level below the last whose lower left corner is at `place`,
  /// within the field.
  [[nodiscard]] int fit(int level, Place place) const {
    return fit_[static_cast<std::size_t>(level)][at(place)];
  }
  /// Whether a head may stand here: in known free space.
  [[nodiscard]] bool is_free(Place place) const { return free_[at(place)]; }

  /// All blocks of the last level.
  [[nodiscard]] Blocks blocks() const { return {0, 0, columns_ / kBlock, rows_ / kBlock}; }
  /// The blocks with a place within `radius_m` of `p_map`, and some more.
  [[nodiscard]] Blocks blocks_around(const Eigen::Vector2d& p_map, double radius_m) const;
  /// Sums the fits of points `offsets` away (kReach at most) from a head anywhere in each block of
  /// the last level: no head in it scores more. Gives those of `among` with a free place and a
  /// bound of `least` or more, row by row.
  void bound_blocks(std::span<const Place> offsets, const Blocks& among, int least,
                    std::vector<BlockBound>& bounds, SearchWork& work);
  /// The lower left corner of a block.
  [[nodiscard]] Place corner_of(std::int32_t block) const {
    return {block % block_stride_ * kBlock, block / block_stride_ * kBlock};
  }

 private:
  /// Blocks on either side of a row that points reach into.
  static constexpr std::int32_t kRim = (kReach + 1) / kBlock;
  /// Of a row of blocks: [first, end).
  struct Run {
    std::int32_t first, end;
  };
  void lay_out(const GridGeometry& geometry, const FitFieldConfig& config);
  void take_tile(const TsdTile& cells, const GridGeometry& geometry, Eigen::Vector2d corner_m);
  void build_row(int level, std::int32_t row);
  void spread_row(std::int32_t row);
  void bound_row(std::int32_t row, Run run, int least, std::vector<BlockBound>& bounds);
  [[nodiscard]] std::size_t at(Place place) const {
    return static_cast<std::size_t>(place.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(place.column);
  }

  double spacing_m_ = 0.1;
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  std::int32_t columns_ = 0, rows_ = 0;  ///< multiples of kBlock
  // What is still to be taken.
  std::vector<TileIndex> tiles_;
  std::size_t next_tile_ = 0;
  int next_level_ = 0;
  std::int32_t next_row_ = 0;
  /// Of each level but the last, the best fit within the block whose lower left corner is here.
  /// Some rows of nothing follow.
  std::array<std::vector<std::int8_t>, kLevels - 1> fit_;
  std::vector<bool> free_;  ///< whether a head may stand here ...
  /// The last level, by (row, column) modulo kBlock, with a rim of nothing beside each row.
  std::vector<std::int8_t> phases_;
  std::vector<std::uint8_t> free_blocks_;  ///< ... or anywhere in this block
  std::int32_t block_stride_ = 0;          ///< from one row of blocks to the next, in both
  std::vector<Run> free_runs_;             ///< of each row: the blocks with a free place
  std::vector<std::int8_t> last_level_;    ///< one row of it
  /// Of each point, while blocks are bounded: its fits in the first row, and how many rows up from
  /// the head it is.
  struct PointFits {
    const std::int8_t* fits;
    std::int32_t up;
  };
  std::vector<PointFits> points_;
  std::vector<const std::int8_t*> row_fits_;
};

}  // namespace lifeline::slam
