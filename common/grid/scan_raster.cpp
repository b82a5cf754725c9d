#include "common/grid/scan_raster.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/cell_lanes.hpp"

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

/// The bits [first, end) of 64; one at least.
std::uint64_t bits_between(std::int32_t first, std::int32_t end) {
  return ~std::uint64_t{0} >> (kTileSide - (end - first)) << first;
}

float reach_of(std::span<const SurfacePiece> pieces) {
  float reach_m = 0.0F;
  for (const SurfacePiece& piece : pieces) reach_m = std::max(reach_m, piece.point.norm());
  return reach_m;
}

}  // namespace

ScanRaster::ScanRaster(GridGeometry geometry, RasterConfig config)
    : geometry_(geometry), free_weight_(config.free_weight) {
  const auto cell_m = static_cast<float>(geometry.cell_size_m);
  const auto truncation_m = static_cast<float>(geometry.truncation_m);
  behind_ = config.behind_m / cell_m;
  before_ = truncation_m / cell_m;
  one_per_cell_ = static_cast<float>(TsdCell::kTsdOne) * cell_m / truncation_m;
}

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
  const auto cell_m = static_cast<float>(geometry_.cell_size_m);
  const auto c = static_cast<float>(std::cos(T_raster_head.yaw_rad));
  const auto s = static_cast<float>(std::sin(T_raster_head.yaw_rad));
  const auto turned = [&](const Eigen::Vector2f& v) {
    return Eigen::Vector2f(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  const Eigen::Vector2f head = T_raster_head.translation().cast<float>();
  for (const SurfacePiece& piece : pieces) {
    draw_piece({head + turned(piece.point) / cell_m, turned(piece.normal), piece.left_m / cell_m,
                piece.right_m / cell_m, piece.quality * weight});
  }
  free_cell_ = {TsdCell::kTsdOne, static_cast<std::uint16_t>(
                                      std::lround(weight * free_weight_ * TsdCell::kWeightOne))};
  if (!free_cell_.known()) return;
  outline_.trace(pieces, T_raster_head, geometry_);
  fill_outline();
}

void ScanRaster::clear() {
  for (std::size_t i = 0; i < used_; ++i) {
    Tile& tile = *tiles_[i];
    for (int row = 0; row < kTileSide; ++row) {
      const auto r = static_cast<std::size_t>(row);
      if (tile.first[r] >= tile.last[r]) continue;
      const auto begin = tile.surfaces.begin() + row * kTileSide;
      std::fill(begin + tile.first[r], begin + tile.last[r], TsdCell{});
    }
  }
  used_ = 0;
}

inline ScanRaster::Tile* ScanRaster::tile_at(TileIndex local) {
  if (local.x < 0 || local.y < 0 || local.x >= columns_ || local.y >= rows_) return nullptr;
  std::int32_t& slot = directory_[static_cast<std::size_t>(local.y * columns_ + local.x)];
  return slot >= 0 ? tiles_[static_cast<std::size_t>(slot)].get() : add_tile(local, slot);
}

ScanRaster::Tile* ScanRaster::add_tile(TileIndex local, std::int32_t& slot) {
  const TileIndex index{first_tile_.x + local.x, first_tile_.y + local.y};
  if (!is_in_range(index)) return nullptr;
  if (used_ == tiles_.size()) tiles_.push_back(std::make_unique<Tile>());
  slot = static_cast<std::int32_t>(used_++);
  Tile& tile = *tiles_[static_cast<std::size_t>(slot)];
  tile.index = index;
  tile.first.fill(kTileSide);
  tile.last.fill(0);
  tile.free.fill(0);
  return &tile;
}

template <typename Use>
void ScanRaster::each_stretch(std::int32_t row, std::int32_t first, std::int32_t last, Use&& use) {
  first = std::max(first, 0);
  last = std::min(last, columns_ * kTileSide - 1);
  for (std::int32_t x = first; x <= last;) {
    const TileIndex index = tile_of({x, row});
    const std::int32_t corner = index.x * kTileSide;
    const std::int32_t end = std::min(last + 1, corner + kTileSide);
    if (Tile* tile = tile_at(index)) {
      use(*tile, corner, x, end);
    }
    x = end;
  }
}

void ScanRaster::draw_piece(const DrawnPiece& piece) {
  const Eigen::Vector2f n = piece.normal, left(-n.y(), n.x());
  const float above = std::max(before_ * n.y(), -behind_ * n.y()) +
                      std::max(piece.left * left.y(), -piece.right * left.y());
  const float below = std::min(before_ * n.y(), -behind_ * n.y()) +
                      std::min(piece.left * left.y(), -piece.right * left.y());
  const std::int32_t high = last_centre_to(piece.point.y() + above);
  for (std::int32_t row = first_centre_from(piece.point.y() + below); row <= high; ++row) {
    const float v = static_cast<float>(row) + 0.5F - piece.point.y();
    const Interval across = solve(left.x(), v * left.y(), -piece.right, piece.left);
    const Interval deep = solve(n.x(), v * n.y(), -behind_, before_);
    draw_row(piece, row,
             first_centre_from(piece.point.x() + std::max({across.low, deep.low, -1e6F})),
             last_centre_to(piece.point.x() + std::min({across.high, deep.high, 1e6F})));
  }
}

void ScanRaster::draw_row(const DrawnPiece& piece, std::int32_t row, std::int32_t first,
                          std::int32_t last) {
  const float along_y = (static_cast<float>(row) + 0.5F - piece.point.y()) * piece.normal.y();
  const IntLanes most = IntLanes{} + TsdCell::kTsdOne;
  const auto draw_four = [&](TsdCell* cells, IntLanes x, IntLanes inside) {
    const FloatLanes d =
        (__builtin_convertvector(x, FloatLanes) + 0.5F - piece.point.x()) * piece.normal.x() +
        along_y;
    const FloatLanes rest = 1.0F + d / behind_;
    const FloatLanes loss = choose(d < 0.0F, rest * rest, FloatLanes{} + 1.0F);
    const IntLanes weight = rounded(piece.quality * loss * static_cast<float>(TsdCell::kWeightOne));
    IntLanes tsd = rounded(d * one_per_cell_);
    tsd = choose(magnitude(tsd) > most, choose(tsd < 0, -most, most), tsd);
    // Where two surfaces are about, the nearer one says how far it is.
    const IntLanes was = load_cells(cells), was_tsd = (was << 16) >> 16;
    const IntLanes is_nearer = (was <= kTsdBits) | (magnitude(tsd) < magnitude(was_tsd));
    const IntLanes drawn = inside & (weight != 0) & is_nearer;
    store_cells(choose(drawn, (weight << 16) | (tsd & kTsdBits), was), cells);
  };
  const auto r = static_cast<std::size_t>(row & (kTileSide - 1));
  each_stretch(row, first, last,
               [&](Tile& tile, std::int32_t corner, std::int32_t x, std::int32_t end) {
                 tile.first[r] = std::min(tile.first[r], static_cast<std::uint8_t>(x - corner));
                 tile.last[r] = std::max(tile.last[r], static_cast<std::uint8_t>(end - corner));
                 TsdCell* cells = tile.surfaces.data() + r * kTileSide;
                 for (std::int32_t four = x / kLanes * kLanes; four < end; four += kLanes) {
                   const IntLanes here = count_from(four);
                   draw_four(cells + (four - corner), here, (here >= x) & (here < end));
                 }
               });
}

void ScanRaster::fill_outline() {
  for (const FreeOutline::Run& run : outline_.runs(rows_ * kTileSide)) {
    const auto r = static_cast<std::size_t>(run.row & (kTileSide - 1));
    each_stretch(run.row, run.first, run.last,
                 [&](Tile& tile, std::int32_t corner, std::int32_t x, std::int32_t end) {
                   tile.free[r] |= bits_between(x - corner, end - corner);
                 });
  }
}

}  // namespace lifeline
