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

// Remembers the last tile looked up: neighbouring cells mostly lie in the same one.
class LayerReader {
 public:
  explicit LayerReader(const ReplicaLayer& layer) : layer_(layer) {}

  QuantisedCell at(std::int64_t x, std::int64_t y) {
    const CellIndex cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    const TileIndex tile = tile_of(cell);
    if (!looked_up_ || tile != tile_) {
      const auto found = layer_.find(tile);
      cells_ = found == layer_.end() ? nullptr : found->second.cells.get();
      tile_ = tile;
      looked_up_ = true;
    }
    return cells_ == nullptr ? QuantisedCell{} : (*cells_)[offset_in_tile(cell)];
  }

 private:
  const ReplicaLayer& layer_;
  TileIndex tile_{};
  const QuantisedTile* cells_ = nullptr;
  bool looked_up_ = false;
};

// Adds the layer's value at `p` (in the layer's frame) to one cell's sums.
void add_sample(LayerReader& layer, PointUm p, std::int64_t cell_um, std::int64_t& weighted_tsd,
                std::int64_t& weight) {
  const std::int64_t from_centre_x = p.x - cell_um / 2, from_centre_y = p.y - cell_um / 2;
  const std::int64_t x = floor_divide(from_centre_x, cell_um);
  const std::int64_t y = floor_divide(from_centre_y, cell_um);
  const std::int64_t fx = (from_centre_x - x * cell_um) * kFractionOne / cell_um;
  const std::int64_t fy = (from_centre_y - y * cell_um) * kFractionOne / cell_um;
  const bool right = fx >= kFractionOne / 2, upper = fy >= kFractionOne / 2;
  if (layer.at(x + (right ? 1 : 0), y + (upper ? 1 : 0)).weight == 0) return;
  const auto add = [&](std::int64_t dx, std::int64_t dy, std::int64_t share) {
    const QuantisedCell cell = layer.at(x + dx, y + dy);
    weighted_tsd += share * cell.weight * cell.tsd;
    weight += share * cell.weight;
  };
  add(0, 0, (kFractionOne - fx) * (kFractionOne - fy));
  add(1, 0, fx * (kFractionOne - fy));
  add(0, 1, (kFractionOne - fx) * fy);
  add(1, 1, fx * fy);
}

void add_member(TileIndex index, const FusedMember& member, std::int64_t cell_um, Sums& sums) {
  LayerReader layer(*member.layer);
  const auto& T = member.T_fused_layer;
  const CellIndex first = first_cell(index);
  std::size_t offset = 0;
  for (int row = 0; row < kTileSide; ++row) {
    const std::int64_t dy = (std::int64_t{first.y} + row) * cell_um + cell_um / 2 - T.y_um;
    for (int column = 0; column < kTileSide; ++column, ++offset) {
      const std::int64_t dx = (std::int64_t{first.x} + column) * cell_um + cell_um / 2 - T.x_um;
      // p_layer = R^T (p_fused - t); the shift of a negative number rounds down since C++20.
      const PointUm p_layer{(T.cos_q30 * dx + T.sin_q30 * dy + kRoundQ30) >> 30,
                            (T.cos_q30 * dy - T.sin_q30 * dx + kRoundQ30) >> 30};
      add_sample(layer, p_layer, cell_um, sums.weighted_tsd[offset], sums.weight[offset]);
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
