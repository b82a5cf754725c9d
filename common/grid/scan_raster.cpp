#include "common/grid/scan_raster.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline {
namespace {

/// A closed interval of one coordinate.
struct Interval {
  float low;
  float high;
};

/// The dx for which low <= dx * slope + constant <= high.
Interval solve(float slope, float constant, float low, float high) {
  constexpr float kFar = 1e9F;
  if (std::abs(slope) < 1e-6F) {
    return constant >= low && constant <= high ? Interval{-kFar, kFar} : Interval{kFar, -kFar};
  }
  const float a = (low - constant) / slope, b = (high - constant) / slope;
  return {std::min(a, b), std::max(a, b)};
}

/// std::lround without a call: a double holds every float and the half that is added exactly.
std::int32_t rounded(float x) {
  const auto exact = static_cast<double>(x);
  return static_cast<std::int32_t>(exact < 0.0 ? exact - 0.5 : exact + 0.5);
}

std::int32_t first_centre_from(float x) {
  return static_cast<std::int32_t>(std::ceil(x - 0.5F));
}
std::int32_t last_centre_to(float x) {
  return static_cast<std::int32_t>(std::floor(x - 0.5F));
}

float reach_of(std::span<const SurfacePiece> pieces) {
  float reach_m = 0.0F;
  for (const SurfacePiece& piece : pieces) reach_m = std::max(reach_m, piece.point.norm());
  return reach_m;
}

/// How far along its beam free space is sure to reach before a piece: to a truncation distance from
/// the surface, measured across it.
float free_reach(const SurfacePiece& piece, float truncation_m) {
  const float range_m = piece.point.norm();
  const float incidence = std::max(-piece.normal.dot(piece.point) / range_m, 0.05F);
  return std::max(0.0F, range_m - truncation_m / incidence);
}

/// The same where a surface may run from `piece` to the nearer neighbour `edge`, unseen.
float free_reach_beside(const SurfacePiece& piece, const SurfacePiece& edge, float truncation_m) {
  const Eigen::Vector2f chord = edge.point - piece.point;
  const float range_m = piece.point.norm();
  const float across = std::abs(chord.x() * piece.point.y() - chord.y() * piece.point.x()) /
                       std::max(chord.norm() * range_m, 1e-6F);
  return std::max(0.0F, range_m - truncation_m / std::max(across, 1e-3F));
}

}  // namespace

ScanRaster::ScanRaster(GridGeometry geometry, RasterConfig config)
    : geometry_(geometry), config_(config) {}

void ScanRaster::draw(std::span<const SurfacePiece> pieces, const Pose2& T_map_head, float weight) {
  clear();
  const double tile_m = geometry_.cell_size_m * kTileSide;
  const double reach_m = reach_of(pieces) + 2.0 * geometry_.truncation_m;
  const auto tile_below = [&](double at_m) {
    return static_cast<std::int32_t>(std::floor((at_m - reach_m) / tile_m));
  };
  first_tile_ = {tile_below(T_map_head.x_m), tile_below(T_map_head.y_m)};
  columns_ = rows_ = static_cast<std::int32_t>(std::ceil(2.0 * reach_m / tile_m)) + 1;
  directory_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);

  // From here on in cells, from the corner of the first tile: small numbers, exact enough in float.
  const CellIndex corner = first_cell(first_tile_);
  const Pose2 T_raster_head{T_map_head.x_m / geometry_.cell_size_m - corner.x,
                            T_map_head.y_m / geometry_.cell_size_m - corner.y, T_map_head.yaw_rad};
  for (const SurfacePiece& piece : pieces) draw_piece(piece, T_raster_head, weight);
  trace_outline(pieces, T_raster_head);
  fill_outline(weight * config_.free_weight);
}

void ScanRaster::clear() {
  for (std::size_t i = 0; i < used_; ++i) {
    Tile& tile = *tiles_[i];
    for (int row = 0; row < kTileSide; ++row) {
      const auto r = static_cast<std::size_t>(row);
      if (tile.first[r] >= tile.last[r]) continue;
      const auto begin = tile.cells.begin() + row * kTileSide;
      std::fill(begin + tile.first[r], begin + tile.last[r], TsdCell{});
    }
  }
  used_ = 0;
}

ScanRaster::Tile* ScanRaster::tile_at(TileIndex local) {
  if (local.x < 0 || local.y < 0 || local.x >= columns_ || local.y >= rows_) return nullptr;
  std::int32_t& slot = directory_[static_cast<std::size_t>(local.y * columns_ + local.x)];
  if (slot >= 0) return tiles_[static_cast<std::size_t>(slot)].get();
  const TileIndex index{first_tile_.x + local.x, first_tile_.y + local.y};
  if (!is_in_range(index)) return nullptr;
  if (used_ == tiles_.size()) tiles_.push_back(std::make_unique<Tile>());
  slot = static_cast<std::int32_t>(used_++);
  Tile& tile = *tiles_[static_cast<std::size_t>(slot)];
  tile.index = index;
  tile.first.fill(kTileSide);
  tile.last.fill(0);
  return &tile;
}

void ScanRaster::draw_piece(const SurfacePiece& piece, const Pose2& T_raster_head, float weight) {
  const auto cell_m = static_cast<float>(geometry_.cell_size_m);
  const auto c = static_cast<float>(std::cos(T_raster_head.yaw_rad));
  const auto s = static_cast<float>(std::sin(T_raster_head.yaw_rad));
  SurfacePiece drawn = piece;  // in cells, in the raster's frame
  drawn.point = {
      static_cast<float>(T_raster_head.x_m) + (c * piece.point.x() - s * piece.point.y()) / cell_m,
      static_cast<float>(T_raster_head.y_m) + (s * piece.point.x() + c * piece.point.y()) / cell_m};
  drawn.normal = {c * piece.normal.x() - s * piece.normal.y(),
                  s * piece.normal.x() + c * piece.normal.y()};
  drawn.left_m /= cell_m;
  drawn.right_m /= cell_m;
  drawn.quality *= weight;
  const float before = static_cast<float>(geometry_.truncation_m) / cell_m;
  const float behind = config_.behind_m / cell_m;
  const Eigen::Vector2f n = drawn.normal, left(-n.y(), n.x());
  const float above = std::max(before * n.y(), -behind * n.y()) +
                      std::max(drawn.left_m * left.y(), -drawn.right_m * left.y());
  const float below = std::min(before * n.y(), -behind * n.y()) +
                      std::min(drawn.left_m * left.y(), -drawn.right_m * left.y());
  const std::int32_t high = last_centre_to(drawn.point.y() + above);
  for (std::int32_t row = first_centre_from(drawn.point.y() + below); row <= high; ++row) {
    const float v = static_cast<float>(row) + 0.5F - drawn.point.y();
    const Interval across = solve(left.x(), v * left.y(), -drawn.right_m, drawn.left_m);
    const Interval deep = solve(n.x(), v * n.y(), -behind, before);
    draw_row(drawn, row,
             first_centre_from(drawn.point.x() + std::max({across.low, deep.low, -1e6F})),
             last_centre_to(drawn.point.x() + std::min({across.high, deep.high, 1e6F})));
  }
}

void ScanRaster::draw_row(const SurfacePiece& piece, std::int32_t row, std::int32_t first,
                          std::int32_t last) {
  const auto cell_m = static_cast<float>(geometry_.cell_size_m);
  const float one_per_cell =
      static_cast<float>(TsdCell::kTsdOne) * cell_m / static_cast<float>(geometry_.truncation_m);
  const float behind = config_.behind_m / cell_m;
  Tile* tile = nullptr;
  for (std::int32_t x = first; x <= last; ++x) {
    const CellIndex cell{x, row};
    if (x == first || (x & (kTileSide - 1)) == 0) tile = tile_at(tile_of(cell));
    if (tile == nullptr) continue;
    const float d = (static_cast<float>(x) + 0.5F - piece.point.x()) * piece.normal.x() +
                    (static_cast<float>(row) + 0.5F - piece.point.y()) * piece.normal.y();
    const float depth_loss = d < 0.0F ? (1.0F + d / behind) * (1.0F + d / behind) : 1.0F;
    const auto weight = static_cast<std::uint16_t>(
        rounded(piece.quality * depth_loss * static_cast<float>(TsdCell::kWeightOne)));
    if (weight == 0) continue;
    const auto tsd = static_cast<std::int16_t>(
        std::clamp(rounded(d * one_per_cell), -TsdCell::kTsdOne, TsdCell::kTsdOne));
    TsdCell& drawn = tile->cells[offset_in_tile(cell)];
    // Where two surfaces are about, the nearer one says how far it is.
    if (drawn.known() && std::abs(drawn.tsd) <= std::abs(tsd)) continue;
    drawn = {tsd, weight};
    const auto r = static_cast<std::size_t>(row & (kTileSide - 1));
    const auto column = static_cast<std::uint8_t>(x & (kTileSide - 1));
    tile->first[r] = std::min(tile->first[r], column);
    tile->last[r] = std::max<std::uint8_t>(tile->last[r], static_cast<std::uint8_t>(column + 1));
  }
}

void ScanRaster::trace_outline(std::span<const SurfacePiece> pieces, const Pose2& T_raster_head) {
  outline_.clear();
  const auto truncation_m = static_cast<float>(geometry_.truncation_m);
  const std::size_t n = pieces.size();
  reach_m_.resize(n);
  for (std::size_t i = 0; i < n; ++i) reach_m_[i] = free_reach(pieces[i], truncation_m);
  for (std::size_t i = 0; i < n; ++i) {
    if (pieces[i].link != SurfaceLink::jump) continue;
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    const bool is_near = pieces[i].point.squaredNorm() < pieces[before].point.squaredNorm();
    const std::size_t near = is_near ? i : before, far = is_near ? before : i;
    reach_m_[far] =
        std::min(reach_m_[far], free_reach_beside(pieces[far], pieces[near], truncation_m));
  }
  const auto cell_m = static_cast<float>(geometry_.cell_size_m);
  const auto c = static_cast<float>(std::cos(T_raster_head.yaw_rad)) / cell_m;
  const auto s = static_cast<float>(std::sin(T_raster_head.yaw_rad)) / cell_m;
  const Eigen::Vector2f head(static_cast<float>(T_raster_head.x_m),
                             static_cast<float>(T_raster_head.y_m));
  const auto add = [&](std::size_t direction_of, float reach_m) {
    const Eigen::Vector2f p =
        pieces[direction_of].point * (reach_m / pieces[direction_of].point.norm());
    outline_.emplace_back(head.x() + c * p.x() - s * p.y(), head.y() + s * p.x() + c * p.y());
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    if (pieces[i].link == SurfaceLink::none) outline_.push_back(head);
    // Between surfaces of different depth, only what lies before both is sure to be free.
    if (pieces[i].link == SurfaceLink::jump) {
      const bool rises = reach_m_[before] < reach_m_[i];
      add(rises ? i : before, std::min(reach_m_[before], reach_m_[i]));
    }
    add(i, reach_m_[i]);
  }
}

void ScanRaster::fill_outline(float weight) {
  const TsdCell free{TsdCell::kTsdOne,
                     static_cast<std::uint16_t>(std::lround(weight * TsdCell::kWeightOne))};
  if (outline_.size() < 3 || free.weight == 0) return;
  const std::int32_t height = rows_ * kTileSide;
  // Calls use(row, x, direction) wherever an edge crosses the middle of a row.
  const auto each_crossing = [&](auto&& use) {
    Eigen::Vector2f a = outline_.back();
    for (const Eigen::Vector2f& b : outline_) {
      const bool up = b.y() > a.y();
      const Eigen::Vector2f &low = up ? a : b, &high = up ? b : a;
      const std::int32_t first = std::max(first_centre_from(low.y()), 0);
      const std::int32_t end = std::min(first_centre_from(high.y()), height);
      if (first < end) {
        const float slope = (high.x() - low.x()) / (high.y() - low.y());
        for (std::int32_t row = first; row < end; ++row) {
          use(row, low.x() + slope * (static_cast<float>(row) + 0.5F - low.y()), up ? 1 : -1);
        }
      }
      a = b;
    }
  };
  row_start_.assign(static_cast<std::size_t>(height) + 1, 0);
  each_crossing([&](std::int32_t row, float, int) { ++row_start_[static_cast<std::size_t>(row)]; });
  std::int32_t total = 0;
  for (std::int32_t& start : row_start_) total = start += total;
  crossings_.resize(static_cast<std::size_t>(total));
  // row_start_ holds the ends now; filling from behind turns them into the starts.
  each_crossing([&](std::int32_t row, float x, int direction) {
    crossings_[static_cast<std::size_t>(--row_start_[static_cast<std::size_t>(row)])] = {x,
                                                                                         direction};
  });
  for (std::int32_t row = 0; row < height; ++row) {
    const auto begin = crossings_.begin() + row_start_[static_cast<std::size_t>(row)];
    const auto end = crossings_.begin() + row_start_[static_cast<std::size_t>(row) + 1];
    std::sort(begin, end, [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    std::int32_t winding = 0;
    for (auto crossing = begin; crossing != end; ++crossing) {
      if (winding != 0) {
        const float from = std::prev(crossing)->x;
        fill_row(row, first_centre_from(from), first_centre_from(crossing->x) - 1, free);
      }
      winding += crossing->direction;
    }
  }
}

void ScanRaster::fill_row(std::int32_t row, std::int32_t first, std::int32_t last, TsdCell value) {
  first = std::max(first, 0);
  last = std::min(last, columns_ * kTileSide - 1);
  for (std::int32_t x = first; x <= last;) {
    const TileIndex index = tile_of({x, row});
    const std::int32_t end = std::min(last, (index.x + 1) * kTileSide - 1);
    if (Tile* tile = tile_at(index)) {
      const auto r = static_cast<std::size_t>(row & (kTileSide - 1));
      const auto from = static_cast<std::uint8_t>(x & (kTileSide - 1));
      const auto to = static_cast<std::uint8_t>((end & (kTileSide - 1)) + 1);
      TsdCell* cells = tile->cells.data() + r * kTileSide;
      for (std::size_t column = from; column < to; ++column) {
        if (!cells[column].known()) cells[column] = value;
      }
      tile->first[r] = std::min(tile->first[r], from);
      tile->last[r] = std::max(tile->last[r], to);
    }
    x = end + 1;
  }
}

}  // namespace lifeline
