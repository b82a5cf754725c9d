// What CorrelativeSearch compares scans with: how well a point fits anywhere around.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "agents/slam/correlative_search.hpp"
#include "common/grid/cell_lanes.hpp"
#include "common/grid/point_transform.hpp"

namespace lifeline::slam {
namespace {

/// How well a scan's point would fit into each of four cells; kUnknown where they are not known.
constexpr std::int32_t kUnknown = -128;
IntLanes fit(IntLanes cells, int free_penalty) {
  const IntLanes tsd = (cells << 16) >> 16;
  // The quotient of small whole numbers, cut off, is exact also by this way.
  const FloatLanes loss = __builtin_convertvector(magnitude(tsd), FloatLanes) /
                          static_cast<float>(TsdCell::kTsdOne / CorrelativeSearch::kFull);
  const IntLanes near = CorrelativeSearch::kFull - __builtin_convertvector(loss, IntLanes);
  const IntLanes known = choose(tsd > TsdCell::kTsdOne * 95 / 100, IntLanes{} - free_penalty, near);
  return choose(cells > kTsdBits, known, IntLanes{} + kUnknown);
}

}  // namespace

void CorrelativeSearch::build_field(const WorkingMap& map, const Pose2& centre, double window_m,
                                    double window_rad) {
  double reach_m = 0.0;
  for (const Eigen::Vector2d& p : points_) reach_m = std::max(reach_m, p.norm());
  reach_m += window_m + 2.0 * spacing_m_;
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  const auto tile_at = [&](double at_m) {
    return static_cast<std::int32_t>(std::floor(at_m / tile_m));
  };
  first_tile_ = {tile_at(centre.x_m - reach_m), tile_at(centre.y_m - reach_m)};
  tile_columns_ = tile_at(centre.x_m + reach_m) - first_tile_.x + 1;
  tile_rows_ = tile_at(centre.y_m + reach_m) - first_tile_.y + 1;
  columns_ = tile_columns_ * kFieldSide;
  rows_ = tile_rows_ * kFieldSide;
  field_origin_m_ = Eigen::Vector2d(first_tile_.x, first_tile_.y) * tile_m;
  field_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_ + kRows) +
                kPlaces);
  mark_needed(centre, window_m, window_rad, tile_m);
  static constexpr TileField kNothing{};
  std::size_t slot = 0;
  for (std::int32_t y = 0; y < tile_rows_; ++y) {
    for (std::int32_t x = 0; x < tile_columns_; ++x) {
      if (!needed_[slot++]) continue;
      const TileIndex index{first_tile_.x + x, first_tile_.y + y};
      const TsdTile* cells = map.find(index);
      const TileField& tile = cells == nullptr ? kNothing : field_of(index, *cells);
      auto to = field_.begin() + std::ptrdiff_t{y * kFieldSide} * columns_ + x * kFieldSide;
      for (auto from = tile.begin(); from != tile.end(); from += kFieldSide, to += columns_) {
        std::copy(from, from + kFieldSide, to);
      }
    }
  }
}

void CorrelativeSearch::mark_needed(const Pose2& centre, double window_m, double window_rad,
                                    double tile_m) {
  needed_.assign(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_),
                 false);
  const PointTransform T_map_head(centre);
  for (const Eigen::Vector2d& p : points_) {
    const Eigen::Vector2d at_m = T_map_head * p - field_origin_m_;
    const double reach_m = window_m + window_rad * p.norm() + 2.0 * spacing_m_;
    const auto tile_at = [&](double along_m, int tiles) {
      return static_cast<int>(std::clamp(std::floor(along_m / tile_m), 0.0, tiles - 1.0));
    };
    const int left = tile_at(at_m.x() - reach_m, tile_columns_);
    const int right = tile_at(at_m.x() + reach_m, tile_columns_);
    const int high = tile_at(at_m.y() + reach_m, tile_rows_);
    for (int y = tile_at(at_m.y() - reach_m, tile_rows_); y <= high; ++y) {
      for (int x = left; x <= right; ++x) {
        needed_[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile_columns_) +
                static_cast<std::size_t>(x)] = true;
      }
    }
  }
}

const CorrelativeSearch::TileField& CorrelativeSearch::field_of(TileIndex tile,
                                                                const TsdTile& cells) {
  const auto [slot, fresh] = fields_.try_emplace(tile);
  if (!fresh) return slot->second;
  const int penalty = static_cast<int>(std::lround(config_.free_penalty * kFull));
  for (int y = 0; y < kFieldSide; ++y) {
    const TsdCell* low = cells.data() + offset_in_tile({0, 2 * y});
    std::array<std::int32_t, kTileSide> best;  // of the two cells above each other
    for (std::size_t x = 0; x < best.size(); x += kLanes) {
      const IntLanes a = fit(load_cells(low + x), penalty);
      const IntLanes b = fit(load_cells(low + kTileSide + x), penalty);
      const IntLanes better = choose(a > b, a, b);
      std::memcpy(&best[x], &better, sizeof better);
    }
    for (std::size_t x = 0; x < kFieldSide; ++x) {
      const std::int32_t best_of_four = std::max(best[2 * x], best[2 * x + 1]);
      slot->second[static_cast<std::size_t>(y) * kFieldSide + x] =
          static_cast<std::int8_t>(best_of_four == kUnknown ? 0 : best_of_four);
    }
  }
  return slot->second;
}

}  // namespace lifeline::slam
