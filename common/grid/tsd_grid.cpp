#include "common/grid/tsd_grid.hpp"

#include <algorithm>

#include "common/base/check.hpp"

namespace lifeline {

TsdTile& TsdGrid::at(TileIndex tile) {
  LIFELINE_CHECK(is_in_range(tile));
  grow_to_hold(tile);
  const std::int64_t column = std::int64_t{tile.x} - first_.x,
                     row = std::int64_t{tile.y} - first_.y;
  auto& slot = directory_[static_cast<std::size_t>(row * columns_ + column)];
  if (slot == nullptr) {
    slot = std::make_unique<TsdTile>();
    ++count_;
  }
  return *slot;
}

void TsdGrid::erase(TileIndex tile) {
  if (find(tile) == nullptr) return;
  const std::int64_t column = std::int64_t{tile.x} - first_.x,
                     row = std::int64_t{tile.y} - first_.y;
  directory_[static_cast<std::size_t>(row * columns_ + column)].reset();
  --count_;
}

void TsdGrid::clear() {
  directory_.clear();
  first_ = {};
  columns_ = rows_ = 0;
  count_ = 0;
}

std::vector<TileIndex> TsdGrid::tiles() const {
  std::vector<TileIndex> found;
  found.reserve(count_);
  for (std::int32_t column = 0; column < columns_; ++column) {
    for (std::int32_t row = 0; row < rows_; ++row) {
      const TileIndex tile{first_.x + column, first_.y + row};
      if (find(tile) != nullptr) found.push_back(tile);
    }
  }
  return found;
}

void TsdGrid::grow_to_hold(TileIndex tile) {
  if (columns_ > 0 && tile.x >= first_.x && tile.x < first_.x + columns_ && tile.y >= first_.y &&
      tile.y < first_.y + rows_) {
    return;
  }
  // A margin of a few tiles, so that a walk in one direction does not move the directory at each
  // step.
  constexpr std::int32_t kMargin = 4;
  TileIndex low{tile.x - kMargin, tile.y - kMargin};
  TileIndex high{tile.x + kMargin, tile.y + kMargin};
  if (columns_ > 0) {
    low = {std::min(low.x, first_.x), std::min(low.y, first_.y)};
    high = {std::max(high.x, first_.x + columns_ - 1), std::max(high.y, first_.y + rows_ - 1)};
  }
  const std::int32_t columns = high.x - low.x + 1, rows = high.y - low.y + 1;
  std::vector<std::unique_ptr<TsdTile>> directory(static_cast<std::size_t>(columns) *
                                                  static_cast<std::size_t>(rows));
  for (std::int32_t row = 0; row < rows_; ++row) {
    for (std::int32_t column = 0; column < columns_; ++column) {
      const auto to =
          static_cast<std::size_t>(row + first_.y - low.y) * static_cast<std::size_t>(columns) +
          static_cast<std::size_t>(column + first_.x - low.x);
      const auto from = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column);
      directory[to] = std::move(directory_[from]);
    }
  }
  directory_ = std::move(directory);
  first_ = low;
  columns_ = columns;
  rows_ = rows;
}

double known_area_m2(const TsdGrid& grid) {
  std::int64_t known = 0;
  for (const TileIndex tile : grid.tiles()) {
    known += std::count_if(grid.find(tile)->begin(), grid.find(tile)->end(),
                           [](TsdCell cell) { return cell.known(); });
  }
  return static_cast<double>(known) * grid.geometry().cell_size_m * grid.geometry().cell_size_m;
}

QuantisedTile quantise(const TsdTile& tile) {
  QuantisedTile quantised;
  std::transform(tile.begin(), tile.end(), quantised.begin(),
                 [](TsdCell cell) { return quantise(cell); });
  return quantised;
}

TsdTile dequantise(const QuantisedTile& tile) {
  TsdTile cells;
  std::transform(tile.begin(), tile.end(), cells.begin(),
                 [](QuantisedCell cell) { return dequantise(cell); });
  return cells;
}

}  // namespace lifeline
