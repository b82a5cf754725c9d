#include "common/sharing/fuse_tile.hpp"

#include <algorithm>

#include "common/sharing/fixed_transform.hpp"

namespace lifeline::sharing {
namespace {

constexpr int kFractionBits = 8;
constexpr std::int64_t kFractionOne = 1 << kFractionBits;
constexpr std::int64_t kMassOne =
    kFractionOne * kFractionOne;  // of the four bilinear shares together
constexpr std::int64_t kRoundQ30 = std::int64_t{1} << 29;

struct Sums {
  std::array<std::int64_t, kTileCells> weighted_tsd;
  std::array<std::int64_t, kTileCells> weight;
};

std::int64_t floor_divide(std::int64_t value, std::int64_t divisor) {
  const std::int64_t quotient = value / divisor;
  return value % divisor < 0 ? quotient - 1 : quotient;
}

std::int64_t round_divide(std::int64_t value, std::int64_t divisor) {
  return value >= 0 ? (value + divisor / 2) / divisor : -((-value + divisor / 2) / divisor);
}

/// The smallest and the largest of a point's coordinates over a tile, which a linear map takes at
/// the tile's corners.
struct Reach {
  std::int64_t low, high;
};

Reach reach(std::int64_t start, std::int64_t along_row, std::int64_t along_column) {
  const auto [low, high] = std::minmax(
      {start, start + along_row, start + along_column, start + along_row + along_column});
  return {low, high};
}

/// A rectangle of a layer's cells, side by side whatever tiles they stand in; unknown where the
/// layer holds no tile.
class Patch {
 public:
  Patch(const ReplicaLayer& layer, CellIndex low, CellIndex high)
      : low_(low), width_(high.x - low.x + 1) {
    const TileIndex first = tile_of(low), last = tile_of(high);
    for (auto held = layer.lower_bound(first); held != layer.end() && held->first.x <= last.x;
         ++held) {
      if (held->first.y < first.y || held->first.y > last.y) continue;
      cells_.resize(static_cast<std::size_t>(width_) *
                    static_cast<std::size_t>(high.y - low.y + 1));
      copy(held->first, *held->second.cells, high);
    }
  }
  [[nodiscard]] bool is_unknown() const { return cells_.empty(); }
  [[nodiscard]] std::int64_t width() const { return width_; }
  /// Row after row.
  [[nodiscard]] const QuantisedCell* cells() const { return cells_.data(); }

 private:
  void copy(TileIndex tile, const QuantisedTile& cells, CellIndex high) {
    const CellIndex corner = first_cell(tile);
    const int x0 = std::max(corner.x, low_.x), x1 = std::min(corner.x + kTileSide - 1, high.x);
    const int y0 = std::max(corner.y, low_.y), y1 = std::min(corner.y + kTileSide - 1, high.y);
    for (int y = y0; y <= y1; ++y) {
      const auto from = cells.begin() + static_cast<std::ptrdiff_t>(offset_in_tile({x0, y}));
      std::copy(from, from + (x1 - x0 + 1),
                cells_.begin() + std::ptrdiff_t{y - low_.y} * width_ + (x0 - low_.x));
    }
  }

  CellIndex low_;
  int width_;
  std::vector<QuantisedCell> cells_;
};

/// Divides lengths by a cell's size: floor(length * kFractionOne / cell), without a division.
class InCells {
 public:
  explicit InCells(std::int64_t cell_um)
      : cell_um_(cell_um), reciprocal_((std::int64_t{1} << kReciprocalBits) / cell_um) {}
  /// `length_um`: not negative, and below 2^(62 - kReciprocalBits - kFractionBits) cells.
  [[nodiscard]] std::int64_t operator()(std::int64_t length_um) const {
    const std::int64_t parts = length_um * kFractionOne;
    const std::int64_t quotient = parts * reciprocal_ >> kReciprocalBits;  // or one less
    return quotient + ((quotient + 1) * cell_um_ <= parts ? 1 : 0);
  }

 private:
  static constexpr int kReciprocalBits = 44;
  std::int64_t cell_um_, reciprocal_;
};

// Adds a layer's value between the four cells around a point to one cell's sums. `corner`: the cell
// below and left of the point, in rows of `width`; fx, fy: how far on the point is.
void add_sample(const QuantisedCell* corner, std::int64_t width, std::int64_t fx, std::int64_t fy,
                std::int64_t& weighted_tsd, std::int64_t& weight) {
  const bool right = fx >= kFractionOne / 2, upper = fy >= kFractionOne / 2;
  if (corner[(right ? 1 : 0) + (upper ? width : 0)].weight == 0) return;
  const auto add = [&](QuantisedCell cell, std::int64_t share) {
    weighted_tsd += share * cell.weight * cell.tsd;
    weight += share * cell.weight;
  };
  const std::int64_t gx = kFractionOne - fx, gy = kFractionOne - fy;
  add(corner[0], gx * gy);
  add(corner[1], fx * gy);
  add(corner[width], gx * fy);
  add(corner[width + 1], fx * fy);
}

void add_member(TileIndex index, const FusedMember& member, std::int64_t cell_um, Sums& sums) {
  // p_layer = R^T (p_fused - t), counted from the centre of the layer's first cell; the shift of a
  // negative number rounds down since C++20.
  const auto& T = member.T_fused_layer;
  const CellIndex first = first_cell(index);
  const std::int64_t dx = std::int64_t{first.x} * cell_um + cell_um / 2 - T.x_um;
  const std::int64_t dy = std::int64_t{first.y} * cell_um + cell_um / 2 - T.y_um;
  const std::int64_t x_q30 = T.cos_q30 * dx + T.sin_q30 * dy + kRoundQ30;
  const std::int64_t y_q30 = T.cos_q30 * dy - T.sin_q30 * dx + kRoundQ30;
  const std::int64_t cos_step = T.cos_q30 * cell_um, sin_step = T.sin_q30 * cell_um;
  const auto cell_at = [cell_um](std::int64_t at_q30) {
    return static_cast<std::int32_t>(floor_divide((at_q30 >> 30) - cell_um / 2, cell_um));
  };
  constexpr std::int64_t kLast = kTileSide - 1;
  const Reach x_reach = reach(x_q30, kLast * cos_step, kLast * sin_step);
  const Reach y_reach = reach(y_q30, -kLast * sin_step, kLast * cos_step);
  const CellIndex low{cell_at(x_reach.low), cell_at(y_reach.low)};
  const Patch patch(*member.layer, low, {cell_at(x_reach.high) + 1, cell_at(y_reach.high) + 1});
  if (patch.is_unknown()) return;

  const InCells in_cells(cell_um);
  const std::int64_t x0_um = low.x * cell_um + cell_um / 2, y0_um = low.y * cell_um + cell_um / 2;
  std::size_t offset = 0;
  for (int row = 0; row < kTileSide; ++row) {
    std::int64_t x = x_q30 + row * sin_step, y = y_q30 + row * cos_step;
    for (int column = 0; column < kTileSide; ++column, ++offset, x += cos_step, y -= sin_step) {
      const std::int64_t px = in_cells((x >> 30) - x0_um), py = in_cells((y >> 30) - y0_um);
      const auto corner =
          patch.cells() + (py >> kFractionBits) * patch.width() + (px >> kFractionBits);
      add_sample(corner, patch.width(), px % kFractionOne, py % kFractionOne,
                 sums.weighted_tsd[offset], sums.weight[offset]);
    }
  }
}

}  // namespace

bool fuse_tile(TileIndex index, const std::vector<FusedMember>& members, std::int64_t cell_size_um,
               FusedTile& tile) {
  Sums sums{};
  for (const FusedMember& member : members) add_member(index, member, cell_size_um, sums);
  bool any = false;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile[i] = {};
    if (sums.weight[i] == 0) continue;
    any = true;
    const std::int64_t weight = round_divide(sums.weight[i], kMassOne);
    tile[i] = {static_cast<std::int8_t>(round_divide(sums.weighted_tsd[i], sums.weight[i])),
               static_cast<std::uint8_t>(std::clamp<std::int64_t>(weight, 1, 255))};
  }
  return any;
}

std::vector<TileIndex> tiles_touched(TileIndex layer_tile,
                                     const wire::FixedTransform& T_fused_layer,
                                     std::int64_t cell_size_um) {
  const std::int64_t side = kTileSide * cell_size_um, margin = 2 * cell_size_um;
  const std::int64_t x0 = layer_tile.x * side - margin, y0 = layer_tile.y * side - margin;
  const std::int64_t x1 = x0 + side + 2 * margin, y1 = y0 + side + 2 * margin;
  const std::array<PointUm, 4> corners = {
      transform(T_fused_layer, {x0, y0}), transform(T_fused_layer, {x1, y0}),
      transform(T_fused_layer, {x0, y1}), transform(T_fused_layer, {x1, y1})};
  const auto [low_x, high_x] =
      std::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
  const auto [low_y, high_y] =
      std::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
  std::vector<TileIndex> touched;
  for (auto x = floor_divide(low_x, side); x <= floor_divide(high_x, side); ++x) {
    for (auto y = floor_divide(low_y, side); y <= floor_divide(high_y, side); ++y) {
      const TileIndex tile{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      if (is_in_range(tile)) touched.push_back(tile);
    }
  }
  return touched;
}

}  // namespace lifeline::sharing
