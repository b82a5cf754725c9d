// The grid against a slow one, and quantising over all values.

#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/grid/tsd_grid.hpp"

namespace lifeline {
namespace {

TEST(TsdGridProperty, HoldsWhatAMapOfCellsHolds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> place(0.0, 400.0);
    TsdGrid grid;
    std::map<CellIndex, TsdCell> slow;
    for (int i = 0; i < 3000; ++i) {
      const CellIndex cell{static_cast<std::int32_t>(place(random)),
                           static_cast<std::int32_t>(place(random))};
      if (i % 500 == 499) {
        grid.erase(tile_of(cell));
        std::erase_if(slow,
                      [&](const auto& entry) { return tile_of(entry.first) == tile_of(cell); });
        continue;
      }
      const TsdCell value{static_cast<std::int16_t>(i), static_cast<std::uint16_t>(i + 1)};
      grid.at(tile_of(cell))[offset_in_tile(cell)] = value;
      slow[cell] = value;
    }
    for (const auto& [cell, value] : slow) ASSERT_EQ(grid.cell(cell), value) << "seed " << seed;
    for (int i = 0; i < 3000; ++i) {
      const CellIndex cell{static_cast<std::int32_t>(place(random)),
                           static_cast<std::int32_t>(place(random))};
      const auto known = slow.find(cell);
      ASSERT_EQ(grid.cell(cell), known == slow.end() ? TsdCell{} : known->second);
    }
    EXPECT_NEAR(known_area_m2(grid), static_cast<double>(slow.size()) * 0.0025, 1e-9);
  }
}

TEST(QuantiseProperty, EveryPublishedCellSurvivesTheWayThereAndBack) {
  for (int weight = 1; weight <= QuantisedCell::kMaxWeight; ++weight) {
    for (int tsd = -QuantisedCell::kTsdOne; tsd <= QuantisedCell::kTsdOne; ++tsd) {
      const QuantisedCell cell{static_cast<std::int8_t>(tsd), static_cast<std::uint8_t>(weight)};
      ASSERT_EQ(quantise(dequantise(cell)), cell) << tsd << ", " << weight;
    }
  }
}

TEST(QuantiseProperty, NoDistanceIsOffByMoreThanHalfAStepNorChangesItsSign) {
  constexpr double kHalfStep = 0.5 * TsdCell::kTsdOne / QuantisedCell::kTsdOne;
  for (int tsd = -TsdCell::kTsdOne; tsd <= TsdCell::kTsdOne; ++tsd) {
    const TsdCell cell{static_cast<std::int16_t>(tsd), 640};
    const TsdCell back = dequantise(quantise(cell));
    ASSERT_LE(std::abs(back.tsd - tsd), kHalfStep + 1.0) << tsd;
    ASSERT_GE(back.tsd * tsd, 0) << tsd;
    ASSERT_EQ(quantise(TsdCell{static_cast<std::int16_t>(-tsd), 640}).tsd, -quantise(cell).tsd)
        << tsd;
  }
}

TEST(QuantiseProperty, AMoreCertainCellNeverBecomesLessCertain) {
  int last = 1;
  for (unsigned weight = 1; weight <= 65535; ++weight) {
    const int quantised = quantise(TsdCell{0, static_cast<std::uint16_t>(weight)}).weight;
    ASSERT_GE(quantised, last);
    ASSERT_LE(quantised, QuantisedCell::kMaxWeight);
    last = quantised;
  }
}

}  // namespace
}  // namespace lifeline
