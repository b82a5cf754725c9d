#include "common/search/search_cells.hpp"

#include <algorithm>

namespace lifeline::search {
namespace {

constexpr std::array<CellIndex, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
static_assert(kBlockSide == 16, "places are shifted by 4");

Cover cover_of(const sharing::FusedTile& tile, int column, int row) {
  int free = 0;
  for (int y = row * kFine; y < (row + 1) * kFine; ++y) {
    for (int x = column * kFine; x < (column + 1) * kFine; ++x) {
      const auto cell = tile[static_cast<std::size_t>(y * kTileSide + x)];
      if (cell.weight == 0) continue;
      if (cell.tsd <= 0) return Cover::wall;
      ++free;
    }
  }
  return 2 * free >= kFine * kFine ? Cover::free : Cover::unknown;
}

}  // namespace

std::uint32_t SearchCells::block_of(TileIndex tile) {
  const auto [at, is_new] =
      block_by_tile_.try_emplace(tile, static_cast<std::uint32_t>(blocks_.size()));
  if (!is_new) return at->second;
  Block block{tile, {}, {}, true};
  for (std::size_t direction = 0; direction < 4; ++direction) {
    const auto other =
        block_by_tile_.find({tile.x + kSteps[direction].x, tile.y + kSteps[direction].y});
    block.beside[direction] = other == block_by_tile_.end() ? kNoCell : other->second;
    if (other != block_by_tile_.end())
      blocks_[other->second].beside[(direction + 2) % 4] = at->second;
  }
  blocks_.push_back(std::move(block));
  cover_.resize(cover_.size() + kBlockCells, Cover::unknown);
  return at->second;
}

void SearchCells::put(TileIndex tile, const sharing::FusedTile* cells) {
  if (cells == nullptr && !block_by_tile_.contains(tile)) return;
  const std::uint32_t number = block_of(tile);
  Cover* cover = cover_.data() + std::size_t{number} * kBlockCells;
  for (int row = 0; row < kBlockSide; ++row) {
    for (int column = 0; column < kBlockSide; ++column)
      *cover++ = cells == nullptr ? Cover::unknown : cover_of(*cells, column, row);
  }
  blocks_[number].is_old = true;
  for (const std::uint32_t other : blocks_[number].beside)
    if (other != kNoCell) blocks_[other].is_old = true;
}

CellId SearchCells::find(CellIndex place) const {
  const auto block = block_by_tile_.find({place.x >> 4, place.y >> 4});
  if (block == block_by_tile_.end()) return kNoCell;
  return block->second * kBlockCells +
         static_cast<CellId>((place.y & 15) * kBlockSide + (place.x & 15));
}

CellIndex SearchCells::place(CellId cell) const {
  const TileIndex tile = blocks_[cell / kBlockCells].tile;
  const int within = static_cast<int>(cell % kBlockCells);
  return {tile.x * kBlockSide + within % kBlockSide, tile.y * kBlockSide + within / kBlockSide};
}

Eigen::Vector2d SearchCells::centre_m(CellId cell) const {
  const CellIndex at = place(cell);
  return {(at.x + 0.5) * cell_m_, (at.y + 0.5) * cell_m_};
}

CellId SearchCells::neighbour(CellId cell, int direction) const {
  const CellIndex step = kSteps[static_cast<std::size_t>(direction)];
  const int within = static_cast<int>(cell % kBlockCells);
  const int x = within % kBlockSide + step.x, y = within / kBlockSide + step.y;
  const auto offset = static_cast<CellId>((y & 15) * kBlockSide + (x & 15));
  if (x >= 0 && y >= 0 && x < kBlockSide && y < kBlockSide)
    return cell - cell % kBlockCells + offset;
  const std::uint32_t other =
      blocks_[cell / kBlockCells].beside[static_cast<std::size_t>(direction)];
  return other == kNoCell ? kNoCell : other * kBlockCells + offset;
}

void SearchCells::find_frontier(std::uint32_t number) {
  Block& block = blocks_[number];
  block.is_old = false;
  block.frontier.clear();
  const CellId first = number * kBlockCells;
  for (CellId cell = first; cell < first + kBlockCells; ++cell) {
    if (cover_[cell] != Cover::free) continue;
    for (int direction = 0; direction < 4; ++direction) {
      if (at(neighbour(cell, direction)) != Cover::unknown) continue;
      block.frontier.push_back(cell);
      break;
    }
  }
}

std::vector<CellId> SearchCells::frontier() {
  std::vector<CellId> all;
  for (std::uint32_t number = 0; number < blocks_.size(); ++number) {
    if (blocks_[number].is_old) find_frontier(number);
    all.insert(all.end(), blocks_[number].frontier.begin(), blocks_[number].frontier.end());
  }
  return all;
}

}  // namespace lifeline::search
