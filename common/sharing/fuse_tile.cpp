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

/// Four cells of a layer: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
using FourCells = std::array<QuantisedCell, 4>;

// Remembers the last tile looked up: neighbouring cells mostly lie in the same one.
class LayerReader {
 public:
  explicit LayerReader(const ReplicaLayer& layer) : layer_(layer) {}

  FourCells four_at(std::int64_t x, std::int64_t y) {
    const CellIndex cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    const std::size_t offset = offset_in_tile(cell);
    if (offset % kTileSide == kTileSide - 1 || offset / kTileSide == kTileSide - 1) {
      return {at(cell), at({cell.x + 1, cell.y}), at({cell.x, cell.y + 1}),
              at({cell.x + 1, cell.y + 1})};
    }
    look_up(tile_of(cell));
    if (cells_ == nullptr) return {};
    const auto corner = cells_->begin() + static_cast<std::ptrdiff_t>(offset);
    return {corner[0], corner[1], corner[kTileSide], corner[kTileSide + 1]};
  }

 private:
  QuantisedCell at(CellIndex cell) {
    look_up(tile_of(cell));
    return cells_ == nullptr ? QuantisedCell{} : (*cells_)[offset_in_tile(cell)];
  }
  void look_up(TileIndex tile) {
    if (looked_up_ && tile == tile_) return;
    const auto found = layer_.find(tile);
    cells_ = found == layer_.end() ? nullptr : found->second.cells.get();
    tile_ = tile;
    looked_up_ = true;
  }

  const ReplicaLayer& layer_;
  TileIndex tile_{};
  const QuantisedTile* cells_ = nullptr;
  bool looked_up_ = false;
};

/// One coordinate of a point that moves by no more than a cell at a time, as a number of whole
/// cells and the rest: without a division for each point.
class CellWalk {
 public:
  CellWalk(std::int64_t at_um, std::int64_t cell_um)
      : cell_um_(cell_um), reciprocal_((std::int64_t{1} << kReciprocalBits) / cell_um) {
    cell_ = floor_divide(at_um, cell_um);
  }
  void move_to(std::int64_t at_um) {
    rest_um_ = at_um - cell_ * cell_um_;
    for (; rest_um_ < 0; rest_um_ += cell_um_) --cell_;
    for (; rest_um_ >= cell_um_; rest_um_ -= cell_um_) ++cell_;
  }
  [[nodiscard]] std::int64_t cell() const { return cell_; }
  /// The rest in parts of kFractionOne of a cell, cut off.
  [[nodiscard]] std::int64_t fraction() const {
    const std::int64_t parts = rest_um_ * kFractionOne;
    const std::int64_t fraction = parts * reciprocal_ >> kReciprocalBits;  // or one less
    return (fraction + 1) * cell_um_ <= parts ? fraction + 1 : fraction;
  }

 private:
  // rest_um_ * kFractionOne * reciprocal_ stays below 2^(kReciprocalBits + kFractionBits).
  static constexpr int kReciprocalBits = 48;
  std::int64_t cell_um_, reciprocal_;
  std::int64_t cell_ = 0, rest_um_ = 0;
};

// Adds the layer's value between the four cells around a point to one cell's sums.
void add_sample(const FourCells& cells, std::int64_t fx, std::int64_t fy,
                std::int64_t& weighted_tsd, std::int64_t& weight) {
  const bool right = fx >= kFractionOne / 2, upper = fy >= kFractionOne / 2;
  if (cells[(right ? 1U : 0U) + (upper ? 2U : 0U)].weight == 0) return;
  const std::int64_t gx = kFractionOne - fx, gy = kFractionOne - fy;
  const std::array<std::int64_t, 4> shares{gx * gy, fx * gy, gx * fy, fx * fy};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    weighted_tsd += shares[i] * cells[i].weight * cells[i].tsd;
    weight += shares[i] * cells[i].weight;
  }
}

void add_member(TileIndex index, const FusedMember& member, std::int64_t cell_um, Sums& sums) {
  LayerReader layer(*member.layer);
  const auto& T = member.T_fused_layer;
  const CellIndex first = first_cell(index);
  const std::int64_t dx = std::int64_t{first.x} * cell_um + cell_um / 2 - T.x_um;
  std::size_t offset = 0;
  for (int row = 0; row < kTileSide; ++row) {
    const std::int64_t dy = (std::int64_t{first.y} + row) * cell_um + cell_um / 2 - T.y_um;
    // p_layer = R^T (p_fused - t), from cell to cell of the row; the shift of a negative number
    // rounds down since C++20. Counted from the centre of the layer's first cell.
    std::int64_t x_q30 = T.cos_q30 * dx + T.sin_q30 * dy + kRoundQ30;
    std::int64_t y_q30 = T.cos_q30 * dy - T.sin_q30 * dx + kRoundQ30;
    CellWalk x((x_q30 >> 30) - cell_um / 2, cell_um), y((y_q30 >> 30) - cell_um / 2, cell_um);
    for (int column = 0; column < kTileSide; ++column, ++offset) {
      x.move_to((x_q30 >> 30) - cell_um / 2);
      y.move_to((y_q30 >> 30) - cell_um / 2);
      add_sample(layer.four_at(x.cell(), y.cell()), x.fraction(), y.fraction(),
                 sums.weighted_tsd[offset], sums.weight[offset]);
      x_q30 += T.cos_q30 * cell_um;
      y_q30 -= T.sin_q30 * cell_um;
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
