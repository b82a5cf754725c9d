// The common map's cells, worked out along rows without divisions, are to the bit those that are
// worked out point by point.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "common/sharing/fuse_tile.hpp"

namespace lifeline::sharing {
namespace {

std::int64_t floor_divide(std::int64_t value, std::int64_t divisor) {
  const std::int64_t quotient = value / divisor;
  return value % divisor < 0 ? quotient - 1 : quotient;
}

std::int64_t round_divide(std::int64_t value, std::int64_t divisor) {
  return value >= 0 ? (value + divisor / 2) / divisor : -((-value + divisor / 2) / divisor);
}

QuantisedCell cell_of(const ReplicaLayer& layer, std::int64_t x, std::int64_t y) {
  const CellIndex cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
  const auto found = layer.find(tile_of(cell));
  return found == layer.end() ? QuantisedCell{} : (*found->second.cells)[offset_in_tile(cell)];
}

/// One cell of the fused map, as the words of fuse_tile() say.
FusedCell slowly_fused(CellIndex cell, const std::vector<FusedMember>& members,
                       std::int64_t cell_um) {
  std::int64_t weighted_tsd = 0, weight = 0;
  for (const auto& [layer, T] : members) {
    const std::int64_t dx = std::int64_t{cell.x} * cell_um + cell_um / 2 - T.x_um;
    const std::int64_t dy = std::int64_t{cell.y} * cell_um + cell_um / 2 - T.y_um;
    constexpr std::int64_t kHalf = std::int64_t{1} << 29;
    const std::int64_t px = (T.cos_q30 * dx + T.sin_q30 * dy + kHalf) >> 30;
    const std::int64_t py = (T.cos_q30 * dy - T.sin_q30 * dx + kHalf) >> 30;
    const std::int64_t x = floor_divide(px - cell_um / 2, cell_um);
    const std::int64_t y = floor_divide(py - cell_um / 2, cell_um);
    const std::int64_t fx = (px - cell_um / 2 - x * cell_um) * 256 / cell_um;
    const std::int64_t fy = (py - cell_um / 2 - y * cell_um) * 256 / cell_um;
    if (cell_of(*layer, x + (fx >= 128 ? 1 : 0), y + (fy >= 128 ? 1 : 0)).weight == 0) continue;
    for (const int up : {0, 1}) {
      for (const int right : {0, 1}) {
        const QuantisedCell near = cell_of(*layer, x + right, y + up);
        const std::int64_t share = (right == 1 ? fx : 256 - fx) * (up == 1 ? fy : 256 - fy);
        weighted_tsd += share * near.weight * near.tsd;
        weight += share * near.weight;
      }
    }
  }
  if (weight == 0) return {};
  return {
      static_cast<std::int8_t>(round_divide(weighted_tsd, weight)),
      static_cast<std::uint8_t>(std::clamp<std::int64_t>(round_divide(weight, 65'536), 1, 255))};
}

ReplicaLayer random_layer(std::mt19937& random) {
  std::uniform_int_distribution<int> tsd(-127, 127), weight(-6, 15);
  ReplicaLayer layer;
  for (std::int32_t x = -2; x <= 1; ++x) {
    for (std::int32_t y = -2; y <= 1; ++y) {
      if (random() % 4 == 0) continue;
      auto cells = std::make_shared<QuantisedTile>();
      for (QuantisedCell& cell : *cells) {
        const int known = std::max(0, weight(random));
        if (known > 0)
          cell = {static_cast<std::int8_t>(tsd(random)), static_cast<std::uint8_t>(known)};
      }
      layer[{x, y}] = {Revision{1}, std::move(cells)};
    }
  }
  return layer;
}

class FuseTile : public testing::TestWithParam<unsigned> {};

TEST_P(FuseTile, GivesTheBitsOfPointByPoint) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> shift_m(-4.0, 4.0), turn(-M_PI, M_PI);
  std::uniform_int_distribution<std::int64_t> any_cell_um(10'000, 300'000);
  const std::vector<ReplicaLayer> layers{random_layer(random), random_layer(random),
                                         random_layer(random)};
  const std::int64_t cell_um = GetParam() % 2 == 0 ? 50'000 : any_cell_um(random);
  // One is not turned, one by a right angle: there points fall on the borders of cells.
  std::vector<FusedMember> members{{&layers[0], to_fixed({})}};
  members.push_back({&layers[1], to_fixed({shift_m(random), shift_m(random), M_PI / 2.0})});
  members.push_back({&layers[2], to_fixed({shift_m(random), shift_m(random), turn(random)})});
  int known = 0;
  for (const TileIndex tile : {TileIndex{0, 0}, TileIndex{-1, -1}, TileIndex{1, -2}}) {
    FusedTile fast;
    const bool any = fuse_tile(tile, members, cell_um, fast);
    bool any_slowly = false;
    for (int y = 0; y < kTileSide; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const CellIndex cell{first_cell(tile).x + x, first_cell(tile).y + y};
        const FusedCell slow = slowly_fused(cell, members, cell_um);
        ASSERT_EQ(fast[offset_in_tile(cell)], slow) << cell.x << ' ' << cell.y;
        any_slowly = any_slowly || slow.weight > 0;
        known += slow.weight > 0 ? 1 : 0;
      }
    }
    EXPECT_EQ(any, any_slowly);
  }
  EXPECT_GT(known, 1000);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FuseTile, testing::Range(1U, 21U));

}  // namespace
}  // namespace lifeline::sharing
