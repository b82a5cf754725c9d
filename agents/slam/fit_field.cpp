#include "agents/slam/fit_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/base/cpu_clones.hpp"

namespace lifeline::slam {
namespace {

constexpr int kFreeFit = -4;
/// The worst, so that the best of a place's cells remains.
constexpr std::int8_t kUnknownFit = std::numeric_limits<std::int8_t>::min();

int fit_of(TsdCell cell) {
  if (cell.tsd > TsdCell::kTsdOne * 95 / 100) return kFreeFit;
  return FitField::kFull -
         (FitField::kFull * std::abs(int{cell.tsd}) + TsdCell::kTsdOne / 2) / TsdCell::kTsdOne;
}

std::int32_t round_up(double cells, int multiple) {
  return static_cast<std::int32_t>(std::ceil(cells / multiple)) * multiple;
}

// Estimated, in steps of SearchWork.
constexpr SearchWork kTileWork = 8'000;
constexpr SearchWork kPlaceWork = 1;  ///< of each level

/// The best of four neighbouring places, `reach` apart, of each place of a row: from its row and
/// the one above it.
LIFELINE_ALSO_FOR_AVX2
void best_of_squares(const std::int8_t* row, const std::int8_t* above, std::ptrdiff_t reach,
                     std::int8_t* best, std::ptrdiff_t count) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    best[i] = std::max(std::max(row[i], row[i + reach]), std::max(above[i], above[i + reach]));
  }
}

}  // namespace

void FitField::clear() {
  for (auto& level : fit_) level = {};
  tiles_ = {};
  phases_ = {};
  free_ = {};
  free_blocks_ = {};
  columns_ = rows_ = 0;
}

void FitField::begin(const WorkingMap& map, const FitFieldConfig& config) {
  clear();
  tiles_ = map.tiles();
  next_tile_ = 0;
  next_level_ = next_row_ = 0;
  if (!tiles_.empty()) lay_out(map.geometry(), config);
}

void FitField::lay_out(const GridGeometry& geometry, const FitFieldConfig& config) {
  TileIndex low = tiles_.front(), high = low;
  for (const TileIndex tile : tiles_) {
    low = {std::min(low.x, tile.x), std::min(low.y, tile.y)};
    high = {std::max(high.x, tile.x), std::max(high.y, tile.y)};
  }
  const double tile_m = geometry.cell_size_m * kTileSide;
  origin_m_ = Eigen::Vector2d(low.x, low.y) * tile_m;
  const Eigen::Vector2d size_m(tile_m * (high.x - low.x + 1), tile_m * (high.y - low.y + 1));
  spacing_m_ = config.spacing_m;
  while (size_m.prod() / (spacing_m_ * spacing_m_) > static_cast<double>(config.max_cells)) {
    spacing_m_ *= 2.0;
  }
  // A rim of unknown cells: no block reaches into the map from outside the field.
  origin_m_ -= Eigen::Vector2d::Constant(kBlock * spacing_m_);
  columns_ = round_up(size_m.x() / spacing_m_, kBlock) + 2 * kBlock;
  rows_ = round_up(size_m.y() / spacing_m_, kBlock) + 2 * kBlock;

  const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
  for (auto& level : fit_) level.assign(columns * (rows + kBlock), 0);
  std::fill_n(fit_[0].begin(), columns * rows, kUnknownFit);
  free_.assign(columns * rows, false);
  last_level_.resize(columns);
  const std::int32_t block_columns = columns_ / kBlock, block_rows = rows_ / kBlock;
  block_stride_ = block_columns + kRim;
  const std::size_t blocks =
      static_cast<std::size_t>(block_stride_) * static_cast<std::size_t>(block_rows);
  phases_.assign(2 * kRim + blocks * kBlock * kBlock + kAtOnce, 0);
  free_blocks_.assign(blocks, 0);
  free_runs_.assign(static_cast<std::size_t>(block_rows), {block_columns, 0});
}

bool FitField::advance(const WorkingMap& map, SearchWork& work) {
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  for (; next_tile_ < tiles_.size(); ++next_tile_) {
    if (work <= 0) return false;
    const TileIndex tile = tiles_[next_tile_];
    if (const TsdTile* found = map.find(tile)) {
      take_tile(*found, map.geometry(), Eigen::Vector2d(tile.x, tile.y) * tile_m - origin_m_);
    }
    work -= kTileWork;
  }
  for (; next_level_ < kLevels; ++next_level_, next_row_ = 0) {
    for (; next_row_ < rows_; ++next_row_) {
      if (work <= 0) return false;
      build_row(next_level_, next_row_);
      work -= kPlaceWork * columns_;
    }
  }
  return true;
}

void FitField::take_tile(const TsdTile& cells, const GridGeometry& geometry,
                         Eigen::Vector2d corner_m) {
  std::array<std::int32_t, kTileSide> columns;
  for (int x = 0; x < kTileSide; ++x) {
    columns[static_cast<std::size_t>(x)] =
        static_cast<std::int32_t>((corner_m.x() + (x + 0.5) * geometry.cell_size_m) / spacing_m_);
  }
  for (int y = 0; y < kTileSide; ++y) {
    const auto row =
        static_cast<std::int32_t>((corner_m.y() + (y + 0.5) * geometry.cell_size_m) / spacing_m_);
    for (int x = 0; x < kTileSide; ++x) {
      const TsdCell cell = cells[offset_in_tile({x, y})];
      if (!cell.known()) continue;
      const std::size_t here = at({columns[static_cast<std::size_t>(x)], row});
      fit_[0][here] = std::max(fit_[0][here], static_cast<std::int8_t>(fit_of(cell)));
      if (cell.tsd > TsdCell::kTsdOne / 2) free_[here] = true;
    }
  }
}

void FitField::build_row(int level, std::int32_t row) {
  const auto first = static_cast<std::ptrdiff_t>(at({0, row}));
  if (level == 0) {
    const auto begin = fit_[0].begin() + first;
    std::replace(begin, begin + columns_, kUnknownFit, std::int8_t{0});
    return;
  }
  // Beyond the ends of rows and field stands the rim, as behind them.
  const std::ptrdiff_t reach = std::ptrdiff_t{1} << (level - 1);
  const std::int8_t* from = fit_[static_cast<std::size_t>(level) - 1].data() + first;
  const bool is_last = level == kLevels - 1;
  std::int8_t* to =
      is_last ? last_level_.data() : fit_[static_cast<std::size_t>(level)].data() + first;
  best_of_squares(from, from + reach * columns_, reach, to, columns_);
  if (is_last) spread_row(row);
}

void FitField::spread_row(std::int32_t row) {
  const std::size_t blocks = free_blocks_.size();
  const std::int32_t block_columns = columns_ / kBlock, block_row = row / kBlock;
  const std::size_t first =
      static_cast<std::size_t>(block_row) * static_cast<std::size_t>(block_stride_);
  Run& run = free_runs_[static_cast<std::size_t>(block_row)];
  for (std::int32_t x = 0; x < kBlock; ++x) {
    const auto phase = static_cast<std::size_t>(row % kBlock * kBlock + x);
    std::int8_t* to = phases_.data() + kRim + phase * blocks + first;
    for (std::int32_t column = 0; column < block_columns; ++column) {
      const std::int32_t here = column * kBlock + x;
      to[column] = last_level_[static_cast<std::size_t>(here)];
      if (!is_free({here, row})) continue;
      free_blocks_[first + static_cast<std::size_t>(column)] = 1;
      run = {std::min(run.first, column), std::max(run.end, column + 1)};
    }
  }
}

}  // namespace lifeline::slam
