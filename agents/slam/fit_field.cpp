#include "agents/slam/fit_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/cpu_clones.hpp"

namespace lifeline::slam {
namespace {

constexpr int kFreeFit = -4;

int fit_of(TsdCell cell) {
  if (cell.tsd > TsdCell::kTsdOne * 95 / 100) return kFreeFit;
  return FitField::kFull -
         (FitField::kFull * std::abs(int{cell.tsd}) + TsdCell::kTsdOne / 2) / TsdCell::kTsdOne;
}

std::int32_t round_up(double cells, int multiple) {
  return static_cast<std::int32_t>(std::ceil(cells / multiple)) * multiple;
}

/// Blocks summed at once; a constant number, so that the compiler makes vectors of them.
constexpr int kBlocksAtOnce = 16;

LIFELINE_ALSO_FOR_AVX2
void add_blocks(const std::int8_t* from, std::int16_t* to, std::int32_t count) {
  for (std::int32_t i = 0; i < count;
       i += kBlocksAtOnce, from += kBlocksAtOnce, to += kBlocksAtOnce) {
    for (int lane = 0; lane < kBlocksAtOnce; ++lane) {
      to[lane] = static_cast<std::int16_t>(to[lane] + from[lane]);
    }
  }
}

}  // namespace

void FitField::clear() {
  for (auto& level : fit_) level = {};
  phases_ = {};
  free_ = {};
  free_blocks_ = {};
  columns_ = rows_ = 0;
}

void FitField::assign(const WorkingMap& map, const FitFieldConfig& config) {
  clear();
  lay_out(map, config);
  if (columns_ == 0) return;
  fill_fit(map);
  for (int level = 1; level < kLevels; ++level) build_level(level);
  build_phases();
}

void FitField::lay_out(const WorkingMap& map, const FitFieldConfig& config) {
  const std::vector<TileIndex> tiles = map.tiles();
  if (tiles.empty()) return;
  TileIndex low = tiles.front(), high = low;
  for (const TileIndex tile : tiles) {
    low = {std::min(low.x, tile.x), std::min(low.y, tile.y)};
    high = {std::max(high.x, tile.x), std::max(high.y, tile.y)};
  }
  const double tile_m = map.geometry().cell_size_m * kTileSide;
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
}

void FitField::fill_fit(const WorkingMap& map) {
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  // The worst first, so that the best of a field's cells remains; what stays is unknown.
  constexpr std::int8_t kUnknown = -128;
  fit_[0].assign(cells, kUnknown);
  free_.assign(cells, 0);
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  for (const TileIndex tile : map.tiles()) {
    if (const TsdTile* found = map.find(tile)) {
      fill_tile(*found, map.geometry(), Eigen::Vector2d(tile.x, tile.y) * tile_m - origin_m_);
    }
  }
  std::replace(fit_[0].begin(), fit_[0].end(), kUnknown, std::int8_t{0});
}

void FitField::fill_tile(const TsdTile& cells, const GridGeometry& geometry,
                         Eigen::Vector2d corner_m) {
  for (int y = 0; y < kTileSide; ++y) {
    const auto row =
        static_cast<std::int32_t>((corner_m.y() + (y + 0.5) * geometry.cell_size_m) / spacing_m_);
    for (int x = 0; x < kTileSide; ++x) {
      const TsdCell cell = cells[offset_in_tile({x, y})];
      if (!cell.known()) continue;
      const auto column =
          static_cast<std::int32_t>((corner_m.x() + (x + 0.5) * geometry.cell_size_m) / spacing_m_);
      const std::size_t here = at({column, row});
      fit_[0][here] = std::max(fit_[0][here], static_cast<std::int8_t>(fit_of(cell)));
      free_[here] |= static_cast<std::uint8_t>(cell.tsd > TsdCell::kTsdOne / 2);
    }
  }
}

void FitField::build_level(int level) {
  const auto& from = fit_[static_cast<std::size_t>(level) - 1];
  auto& to = fit_[static_cast<std::size_t>(level)];
  const int reach = 1 << (level - 1);
  to = from;
  for (std::int32_t row = 0; row < rows_; ++row) {  // along x ...
    const std::int8_t* in = from.data() + at({0, row});
    std::int8_t* out = to.data() + at({0, row});
    for (std::int32_t column = 0; column < columns_; ++column) {
      out[column] =
          std::max(in[column], column + reach < columns_ ? in[column + reach] : std::int8_t{0});
    }
  }
  for (std::int32_t row = 0; row < rows_; ++row) {  // ... then along y, upwards: in place
    std::int8_t* out = to.data() + at({0, row});
    const std::int8_t* above = row + reach < rows_ ? to.data() + at({0, row + reach}) : nullptr;
    for (std::int32_t column = 0; column < columns_; ++column) {
      out[column] = std::max(out[column], above != nullptr ? above[column] : std::int8_t{0});
    }
  }
}

void FitField::build_phases() {
  const auto block_at = [this](std::int32_t row, std::int32_t column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(block_stride_) +
           static_cast<std::size_t>(column);
  };
  const auto& top = fit_[kLevels - 1];
  const std::int32_t block_columns = columns_ / kBlock, block_rows = rows_ / kBlock;
  // Rows are summed in whole vectors, which may reach into the rim behind their ends.
  block_stride_ = block_columns + kBlocksAtOnce;
  const std::size_t blocks =
      static_cast<std::size_t>(block_stride_) * static_cast<std::size_t>(block_rows);
  phases_.assign(blocks * kBlock * kBlock + kBlocksAtOnce, 0);
  free_blocks_.assign(blocks, 0);
  for (int y = 0; y < kBlock; ++y) {
    for (int x = 0; x < kBlock; ++x) {
      std::int8_t* phase = phases_.data() + static_cast<std::size_t>(y * kBlock + x) * blocks;
      for (std::int32_t row = 0; row < block_rows; ++row) {
        for (std::int32_t column = 0; column < block_columns; ++column) {
          const std::size_t here = at({column * kBlock + x, row * kBlock + y});
          const std::size_t block = block_at(row, column);
          phase[block] = top[here];
          free_blocks_[block] |= free_[here];
        }
      }
    }
  }
  free_runs_.assign(static_cast<std::size_t>(block_rows), {block_columns, 0});
  for (std::int32_t row = 0; row < block_rows; ++row) {
    Run& run = free_runs_[static_cast<std::size_t>(row)];
    for (std::int32_t column = 0; column < block_columns; ++column) {
      if (!has_free_place(block_at(row, column))) continue;
      run = {std::min(run.first, column), column + 1};
    }
  }
}

void FitField::bound_blocks(std::span<const Place> offsets, std::vector<std::int16_t>& sums) const {
  const std::int32_t columns = columns_ / kBlock, rows = rows_ / kBlock;
  const std::size_t blocks = free_blocks_.size();
  sums.assign(blocks + kBlocksAtOnce, 0);
  for (const Place& offset : offsets) {
    const int phase = (offset.row & (kBlock - 1)) * kBlock + (offset.column & (kBlock - 1));
    const std::int32_t right = offset.column >> (kLevels - 1), up = offset.row >> (kLevels - 1);
    const std::int8_t* field = phases_.data() + static_cast<std::size_t>(phase) * blocks;
    for (std::int32_t row = std::max(0, -up); row < std::min(rows, rows - up); ++row) {
      const Run& run = free_runs_[static_cast<std::size_t>(row)];
      const std::int32_t first = std::max(run.first, -right);
      const std::int32_t count = std::min(run.end, columns - right) - first;
      if (count <= 0) continue;
      add_blocks(field + std::ptrdiff_t{row + up} * block_stride_ + right + first,
                 sums.data() + std::ptrdiff_t{row} * block_stride_ + first, count);
    }
  }
  sums.resize(blocks);
}

}  // namespace lifeline::slam
