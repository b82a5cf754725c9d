#include "coordinator/matching/wall_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "coordinator/matching/known_cells.hpp"

namespace lifeline::matching {
namespace {

constexpr float kEighth = std::numbers::pi_v<float> / 4;
/// A sector answers for normals within half an eighth of its own; its walls may differ from those
/// by another 25 degrees. Walls at right angles to the question are never in it.
constexpr float kSectorHalfWidth = kEighth / 2 + 25.0F * std::numbers::pi_v<float> / 180;

}  // namespace

WallField::WallField(const OccupancyGrid& grid, const std::vector<WallPoint>& walls) {
  inverse_square_m_ = 0.5F / static_cast<float>(grid.cell_size_m);
  columns_ = (grid.columns + 1) / 2;
  rows_ = (grid.rows + 1) / 2;
  block_columns_ = (columns_ + kBlock - 1) / kBlock;
  const int block_rows = (rows_ + kBlock - 1) / kBlock;
  blocks_.assign(static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows),
                 kNone);
  std::vector<float> distances2;
  for (std::size_t i = 0; i < walls.size(); ++i) stamp(static_cast<int>(i), walls[i], distances2);
  classify(grid);
}

std::size_t WallField::entry_for_writing(int x, int y, int sector, std::vector<float>& distances2) {
  std::int32_t& block =
      blocks_[static_cast<std::size_t>((y / kBlock) * block_columns_ + x / kBlock)];
  if (block == kNone) {
    block = static_cast<std::int32_t>(entries_.size());
    entries_.resize(entries_.size() + kBlockEntries, kNone);
    distances2.resize(entries_.size(), std::numeric_limits<float>::infinity());
  }
  return static_cast<std::size_t>(block) +
         static_cast<std::size_t>((sector * kBlock + y % kBlock) * kBlock + x % kBlock);
}

void WallField::stamp(int index, const WallPoint& wall, std::vector<float>& distances2) {
  const float x = wall.p.x() * inverse_square_m_, y = wall.p.y() * inverse_square_m_;
  const float reach = kReach_m * inverse_square_m_;
  const float facing = std::atan2(wall.normal.y(), wall.normal.x());
  const int first_x = std::max(0, static_cast<int>(std::ceil(x - reach - 0.5F)));
  const int first_y = std::max(0, static_cast<int>(std::ceil(y - reach - 0.5F)));
  const int last_x = std::min(columns_ - 1, static_cast<int>(std::floor(x + reach - 0.5F)));
  const int last_y = std::min(rows_ - 1, static_cast<int>(std::floor(y + reach - 0.5F)));
  for (int sector = 0; sector < kSectors; ++sector) {
    const float off = std::remainder(facing - static_cast<float>(sector) * kEighth, 8 * kEighth);
    if (std::abs(off) > kSectorHalfWidth) continue;
    for (int sy = first_y; sy <= last_y; ++sy) {
      for (int sx = first_x; sx <= last_x; ++sx) {
        const float dx = static_cast<float>(sx) + 0.5F - x, dy = static_cast<float>(sy) + 0.5F - y;
        const float distance2 = dx * dx + dy * dy;
        if (distance2 > reach * reach) continue;
        const std::size_t entry = entry_for_writing(sx, sy, sector, distances2);
        if (distance2 < distances2[entry]) {
          distances2[entry] = distance2;
          entries_[entry] = index;
        }
      }
    }
  }
}

int WallField::nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal) const {
  const float fx = p.x() * inverse_square_m_, fy = p.y() * inverse_square_m_;
  if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(columns_) &&
        fy < static_cast<float>(rows_))) {
    return kNone;
  }
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const std::int32_t block =
      blocks_[static_cast<std::size_t>((y / kBlock) * block_columns_ + x / kBlock)];
  if (block == kNone) return kNone;
  // The eighth of the circle in which the normal lies, without an arc tangent: tan(22.5 deg).
  constexpr float kTan = 0.41421356F;
  const float ax = std::abs(normal.x()), ay = std::abs(normal.y());
  int sector = ay < kTan * ax ? 0 : (ax < kTan * ay ? 2 : 1);
  if (normal.x() < 0) sector = 4 - sector;
  if (normal.y() < 0) sector = (8 - sector) & 7;
  return entries_[static_cast<std::size_t>(block) +
                  static_cast<std::size_t>((sector * kBlock + y % kBlock) * kBlock + x % kBlock)];
}

WallField::Place WallField::place(const Eigen::Vector2f& p) const {
  const float fx = p.x() * inverse_square_m_, fy = p.y() * inverse_square_m_;
  if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(columns_) &&
        fy < static_cast<float>(rows_))) {
    return Place::unknown;
  }
  return places_[static_cast<std::size_t>(static_cast<int>(fy) * columns_ + static_cast<int>(fx))];
}

bool WallField::coarse_clear(const Eigen::Vector2f& p) const {
  const float fx = p.x() * inverse_square_m_ / kCoarse, fy = p.y() * inverse_square_m_ / kCoarse;
  if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(coarse_columns_) &&
        fy < static_cast<float>(coarse_rows_))) {
    return false;
  }
  return coarse_clear_[static_cast<std::size_t>(static_cast<int>(fy) * coarse_columns_ +
                                                static_cast<int>(fx))];
}

namespace {

using Mask = std::vector<std::uint8_t>;  // per square, 0 or 1

/// Sets each square that has a set one within `reach` squares in x and in y. Rows run into each
/// other: the border squares must not matter.
Mask spread(const Mask& mask, int columns, int rows, int reach) {
  Mask across = mask;
  const auto width = static_cast<std::ptrdiff_t>(columns), size = width * rows;
  for (int step = 1; step <= reach; ++step) {
    for (std::ptrdiff_t i = step; i + step < size; ++i) {
      across[static_cast<std::size_t>(i)] |= static_cast<std::uint8_t>(
          mask[static_cast<std::size_t>(i - step)] | mask[static_cast<std::size_t>(i + step)]);
    }
  }
  Mask out = across;
  for (int step = 1; step <= reach; ++step) {
    const std::ptrdiff_t by = step * width;
    for (std::ptrdiff_t i = by; i + by < size; ++i) {
      out[static_cast<std::size_t>(i)] |= static_cast<std::uint8_t>(
          across[static_cast<std::size_t>(i - by)] | across[static_cast<std::size_t>(i + by)]);
    }
  }
  return out;
}

}  // namespace

void WallField::classify(const OccupancyGrid& grid) {
  const auto squares = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  Mask wall(squares, 0), unknown(squares, 1);
  for (int y = 0; y < grid.rows; ++y) {
    const Occupancy* const cells = grid.cells.data() + grid.index(0, y);
    const std::size_t row = static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(columns_);
    for_known_cells(cells, grid.columns, [&](int x) {
      const std::size_t square = row + static_cast<std::size_t>(x / 2);
      unknown[square] = 0;
      if (cells[x] == Occupancy::occupied) wall[square] = 1;
    });
  }
  // Clear: itself and its eight neighbours free, and no wall among the next sixteen. The grid has
  // a border of unknown cells, so nothing is clear there.
  const Mask near_wall = spread(wall, columns_, rows_, 2);
  const Mask near_unknown = spread(unknown, columns_, rows_, 1);
  places_.assign(squares, Place::unknown);
  for (std::size_t i = 0; i < squares; ++i) {
    if (unknown[i] != 0) continue;
    places_[i] = near_wall[i] == 0 && near_unknown[i] == 0 ? Place::clear : Place::known;
  }
  coarsen();
}

void WallField::coarsen() {
  constexpr int kEnough = 4 * kCoarse * kCoarse / 5;
  coarse_columns_ = (columns_ + kCoarse - 1) / kCoarse;
  coarse_rows_ = (rows_ + kCoarse - 1) / kCoarse;
  std::vector<int> counts(
      static_cast<std::size_t>(coarse_columns_) * static_cast<std::size_t>(coarse_rows_), 0);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      if (places_[static_cast<std::size_t>(y * columns_ + x)] != Place::clear) continue;
      ++counts[static_cast<std::size_t>((y / kCoarse) * coarse_columns_ + x / kCoarse)];
    }
  }
  coarse_clear_.reserve(counts.size());
  for (const int count : counts) coarse_clear_.push_back(count >= kEnough);
}

}  // namespace lifeline::matching
