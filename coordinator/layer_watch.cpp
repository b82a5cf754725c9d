#include "coordinator/layer_watch.hpp"

#include <cstdlib>
#include <utility>

namespace lifeline {
namespace {

constexpr int kRevisedBy = QuantisedCell::kTsdOne / 3;
// A cell seen once or twice may still change its mind.
constexpr int kSettledWeight = 2;

bool is_wall(QuantisedCell cell) {
  return cell.weight != 0 && std::abs(cell.tsd) < QuantisedCell::kTsdOne;
}

// From here on a coarse cell stands for anything up to free (wire::kCoarseLevels): a wall that
// moved shows in the cells beside.
constexpr int kInFront = 32;

bool is_revised(QuantisedCell before, QuantisedCell now) {
  if (!is_wall(before) || before.weight < kSettledWeight) return false;
  if (now.weight == 0) return true;
  if (before.tsd >= kInFront && now.tsd >= kInFront) return false;
  return std::abs(now.tsd - before.tsd) > kRevisedBy;
}

}  // namespace

void LayerWatch::note(TileIndex tile, std::shared_ptr<const QuantisedTile> cells) {
  Seen& seen = tiles_[tile];
  if (seen.cells == cells) return;
  Seen now{std::move(cells), 0, {}};
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const std::size_t at = offset_in_tile({x, y});
      const QuantisedCell cell = (*now.cells)[at];
      if (seen.cells && is_revised((*seen.cells)[at], cell)) ++revised_cells_;
      if (cell.weight == 0) continue;
      now.wall_cells += is_wall(cell) ? 1U : 0U;
      now.known.extend(Eigen::Vector2i(tile.x * kTileSide + x, tile.y * kTileSide + y));
    }
  }
  wall_cells_ = wall_cells_ - seen.wall_cells + now.wall_cells;
  seen = std::move(now);
}

Eigen::AlignedBox2d LayerWatch::extent(double cell_size_m) const {
  Eigen::AlignedBox2i known;
  for (const auto& [tile, seen] : tiles_) known.extend(seen.known);
  if (known.isEmpty()) return {};
  return {known.min().cast<double>() * cell_size_m,
          (known.max().array() + 1).cast<double>().matrix() * cell_size_m};
}

}  // namespace lifeline
