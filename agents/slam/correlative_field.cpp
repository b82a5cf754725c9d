// What CorrelativeSearch compares scans with: how well a point fits anywhere around.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "agents/slam/correlative_search.hpp"
#include "common/base/cpu_clones.hpp"
#include "common/grid/cell_lanes.hpp"
#include "common/grid/point_transform.hpp"

namespace lifeline::slam {
namespace {

/// What a cell is to a scan's point: how far off its surface is, in TsdCell units, or one of these.
/// The least of several cells fits best.
constexpr std::int32_t kFreeSpace = TsdCell::kTsdOne + 1, kNotKnown = TsdCell::kTsdOne + 2;

/// The best fit of each two by two cells of two rows.
LIFELINE_ALSO_FOR_AVX2
void fit_rows(const TsdCell* low, const TsdCell* high, std::int32_t fit_of_free,
              std::int8_t* fits) {
  constexpr std::int32_t kLossUnit = TsdCell::kTsdOne / CorrelativeSearch::kFull;
  std::array<std::int32_t, kTileSide> a, b;
  std::memcpy(a.data(), low, sizeof a);
  std::memcpy(b.data(), high, sizeof b);
  const auto distance = [](std::int32_t cell) {
    const std::int32_t tsd = static_cast<std::int16_t>(cell & kTsdBits);
    const std::int32_t known = tsd > TsdCell::kTsdOne * 95 / 100 ? kFreeSpace : std::abs(tsd);
    return cell > kTsdBits ? known : kNotKnown;
  };
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::min(distance(a[i]), distance(b[i]));
  for (std::size_t i = 0; i < a.size() / 2; ++i) {
    const std::int32_t least = std::min(a[2 * i], a[2 * i + 1]);
    const std::int32_t fit = CorrelativeSearch::kFull - least / kLossUnit;
    fits[i] = static_cast<std::int8_t>(least < kFreeSpace    ? fit
                                       : least == kFreeSpace ? fit_of_free
                                                             : 0);
  }
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
    fit_rows(low, low + kTileSide, -penalty,
             slot->second.data() + static_cast<std::ptrdiff_t>(y) * kFieldSide);
  }
  return slot->second;
}

}  // namespace lifeline::slam
