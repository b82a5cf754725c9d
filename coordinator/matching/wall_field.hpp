#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "coordinator/matching/wall_points.hpp"

namespace lifeline::matching {

/// Answers two questions about a place in a map: which wall facing a given way is nearest, and is
/// the place known to be free of walls. Squares of two map cells; memory grows with the length of
/// wall, not with the area. Immutable once built.
class WallField {
 public:
  /// Walls further than this from a place are not found.
  static constexpr float kReach_m = 0.45F;
  static constexpr int kNone = -1;

  WallField() = default;
  /// `walls` in the local frame whose origin is the lower left corner of `grid`; kept by index.
  WallField(const OccupancyGrid& grid, const std::vector<WallPoint>& walls);

  /// Index of the nearest wall point that faces about like `normal`, or kNone.
  [[nodiscard]] int nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal) const;

  enum class Place : std::uint8_t { unknown, known, clear };
  /// clear: seen free, and no wall within about 0.2 m. known: free or wall, but not clear.
  [[nodiscard]] Place place(const Eigen::Vector2f& p) const;

  /// The clear space in coarse squares, for the search: clear where nearly all of a square is.
  [[nodiscard]] float coarse_square_m() const { return kCoarse / inverse_square_m_; }
  [[nodiscard]] int coarse_columns() const { return coarse_columns_; }
  [[nodiscard]] int coarse_rows() const { return coarse_rows_; }
  [[nodiscard]] bool coarse_clear(const Eigen::Vector2f& p) const;

 private:
  static constexpr int kSectors = 8;  // facing directions
  static constexpr int kBlock = 8;    // squares along one side of a block
  static constexpr int kCoarse = 5;   // squares along one side of a coarse one
  static constexpr int kBlockEntries = kSectors * kBlock * kBlock;

  void classify(const OccupancyGrid& grid);
  void coarsen();
  void stamp(int index, const WallPoint& wall, std::vector<float>& distances2);
  [[nodiscard]] std::size_t entry_for_writing(int x, int y, int sector,
                                              std::vector<float>& distances2);

  float inverse_square_m_ = 0.0F;
  int columns_ = 0;  // squares
  int rows_ = 0;
  int block_columns_ = 0;
  std::vector<Place> places_;
  std::vector<std::int32_t> blocks_;   // per block: index of its first entry, or kNone
  std::vector<std::int32_t> entries_;  // per block, sector and square: index of a wall point
  int coarse_columns_ = 0;
  int coarse_rows_ = 0;
  std::vector<bool> coarse_clear_;
};

}  // namespace lifeline::matching
