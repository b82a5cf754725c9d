#include "common/wire/coarse_cells.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "common/wire/tile_codec.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/tiles.hpp"

namespace lifeline::wire {
namespace {

QuantisedTile uniform(int tsd, int weight) {
  QuantisedTile tile{};
  for (auto& cell : tile) cell = {static_cast<std::int8_t>(tsd), static_cast<std::uint8_t>(weight)};
  return tile;
}

int level(int tsd, const QuantisedTile* held = nullptr) {
  return coarse(uniform(tsd, 6), held)[0].tsd;
}

/// Each distance moved by up to `by`, where the cell is known and not clearly free.
QuantisedTile trembling(QuantisedTile tile, std::mt19937& random, int by) {
  std::uniform_int_distribution<int> shift(-by, by);
  for (auto& cell : tile) {
    if (cell.weight == 0 || cell.tsd > 100) continue;
    cell.tsd = static_cast<std::int8_t>(std::clamp(cell.tsd + shift(random), -127, 127));
  }
  return tile;
}

std::size_t differing(const QuantisedTile& a, const QuantisedTile& b) {
  std::size_t cells = 0;
  for (std::size_t i = 0; i < a.size(); ++i) cells += a[i] == b[i] ? 0U : 1U;
  return cells;
}

TEST(CoarseCells, WithoutAPastADistanceGoesToTheNearestLevelOfItsSide) {
  EXPECT_EQ(level(-127), -32);
  EXPECT_EQ(level(-22), -32);
  EXPECT_EQ(level(-21), -10);
  EXPECT_EQ(level(0), -10);
  EXPECT_EQ(level(1), 10);
  EXPECT_EQ(level(21), 10);
  EXPECT_EQ(level(22), 32);
  EXPECT_EQ(level(127), 127);
}

TEST(CoarseCells, ACellStaysWhereItIsHeldUntilItIsClearlyElsewhere) {
  const auto front = coarse(uniform(10, 6)), behind = coarse(uniform(-10, 6));
  EXPECT_EQ(level(-4, &front), 10);
  EXPECT_EQ(level(-5, &front), -10);
  EXPECT_EQ(level(5, &behind), -10);
  EXPECT_EQ(level(6, &behind), 10);
  const auto clear = coarse(uniform(127, 6));
  EXPECT_EQ(level(64, &clear), 127);
  EXPECT_EQ(level(63, &clear), 32);
}

TEST(CoarseCells, AWeightStaysAsItIsHeldWhileInDoubt) {
  const auto weight = [](int fine, const QuantisedTile* held) {
    return int{coarse(uniform(50, fine), held)[500].weight};
  };
  const auto thin = coarse(uniform(50, 1)), well = coarse(uniform(50, 9));
  EXPECT_EQ(weight(2, nullptr), kWellSeen);
  EXPECT_EQ(weight(2, &thin), kThin);
  EXPECT_EQ(weight(2, &well), kWellSeen);
  EXPECT_EQ(weight(3, &thin), kWellSeen);
  EXPECT_EQ(weight(1, nullptr), kThin);
}

TEST(CoarseCells, KnowsTheSameCellsWhateverIsHeld) {
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    const auto tile = support::random_tile(random, 0.025 * i);
    const auto held =
        i % 3 == 0 ? support::random_tile(random, 0.5) : coarse(support::random_tile(random, 0.5));
    const auto made = coarse(tile, &held);
    ASSERT_TRUE(is_coarse(made));
    for (std::size_t k = 0; k < tile.size(); ++k)
      ASSERT_EQ(made[k].weight != 0, tile[k].weight != 0);
  }
}

TEST(CoarseCells, WhatWasMadeOfATileIsMadeOfItAgain) {
  std::mt19937 random(6);
  for (int i = 0; i < 60; ++i) {
    const auto tile = i % 2 == 0 ? support::random_tile(random, 0.016 * i)
                                 : support::wall_tile(0.1 * i, 0.3 * i - 9.0);
    const auto held = coarse(support::wall_tile(0.1 * i + 0.02, 0.3 * i - 9.0));
    const auto once = coarse(tile, &held);
    ASSERT_EQ(coarse(tile, &once), once) << i;
    const auto fresh = coarse(tile);
    ASSERT_EQ(coarse(tile, &fresh), fresh) << i;
  }
}

TEST(CoarseCells, WhatWasReceivedGoesOnAsTheSameOctets) {
  std::mt19937 random(7);
  QuantisedTile held = coarse(support::wall_tile(0.2));
  for (int i = 0; i < 60; ++i) {
    held = coarse(i % 4 == 0 ? support::random_tile(random, 0.3)
                             : trembling(support::wall_tile(0.2, 0.1 * i), random, 20),
                  &held);
    const auto payload = encode_tile(held, kGeometry);
    const auto received = decode_tile(payload, kGeometry);
    ASSERT_TRUE(received);
    ASSERT_EQ(*received, held);
    ASSERT_EQ(encode_tile(*received, kGeometry), payload);
  }
}

TEST(CoarseCells, ATremblingWallChangesFewCells) {
  std::mt19937 random(8);
  for (int i = 0; i < 20; ++i) {
    const auto wall = support::wall_tile(0.17 * i);
    auto held = coarse(wall);
    std::size_t with = 0, without = 0;
    for (int k = 0; k < 10; ++k) {
      const auto seen = trembling(wall, random, 4);
      const auto next = coarse(seen, &held);
      with += differing(next, held);
      without += differing(coarse(seen), coarse(trembling(wall, random, 4)));
      held = next;
    }
    EXPECT_LE(4 * with, without) << i;
  }
}

}  // namespace
}  // namespace lifeline::wire
