// What is done to four cells at once is what would be done to each alone, to the bit.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/grid/cell_lanes.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline {
namespace {

using support::scan_of;
using support::small_flat;

TEST(CellLanes, RoundAsOneNumberAlone) {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> any_number(-40000.0F, 40000.0F), small(-2.0F, 2.0F);
  std::uniform_int_distribution<int> whole(-40000, 40000);
  const auto expect_rounded = [](float x) {
    const IntLanes lanes = rounded(FloatLanes{x, -x, std::nextafter(x, 0.0F), 2.0F * x});
    EXPECT_EQ(lanes[0], std::lround(x)) << x;
    EXPECT_EQ(lanes[1], std::lround(-x)) << -x;
    EXPECT_EQ(lanes[2], std::lround(std::nextafter(x, 0.0F))) << x;
    EXPECT_EQ(lanes[3], std::lround(2.0F * x)) << 2.0F * x;
  };
  for (int i = 0; i < 5000; ++i) {
    expect_rounded(any_number(random));
    expect_rounded(small(random));
    expect_rounded(static_cast<float>(whole(random)) + 0.5F);
  }
  expect_rounded(0.0F);
}

TEST(CellLanes, ChooseAndMagnitudeKeepTheLanesApart) {
  const IntLanes a{1, -2, 3, -4}, b{-10, 20, 0, -40};
  const IntLanes larger = choose(a > b, a, b), sizes = magnitude(b);
  const IntLanes expected{1, 20, 3, -4}, expected_sizes{10, 20, 0, 40};
  EXPECT_FALSE(any(larger ^ expected));
  EXPECT_FALSE(any(sizes ^ expected_sizes));
  EXPECT_TRUE(any(IntLanes{0, 0, 0, 1}));
  EXPECT_TRUE(any(IntLanes{1, 0, 0, 0}));
}

/// Merges what one scan shows into `grid`, cell by cell.
void push_slowly(const ScanRaster& raster, Looks looks, int weight_cap, TsdGrid& grid) {
  for (const auto& seen : raster.tiles()) {
    TsdTile& tile = grid.at(seen->index);
    for (std::size_t i = 0; i < tile.size(); ++i) {
      const TsdCell cell = raster.cell(*seen, i);
      tile[i] = looks == Looks::dense ? updated_densely(tile[i], cell, weight_cap)
                                      : updated(tile[i], cell, weight_cap);
    }
  }
}

class PushLanes : public ::testing::TestWithParam<std::tuple<unsigned, double>> {};

TEST_P(PushLanes, MergeAsCellByCell) {
  const auto [seed, weight_cap] = GetParam();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> near(-1.2, 1.2), turn(-M_PI, M_PI), weight(0.1, 1.0);
  const PushConfig config{.weight_cap = weight_cap, .raster = {}};
  TsdUpdater updater(kGeometry, config);
  ScanRaster raster(kGeometry, config.raster);
  TsdGrid fast(kGeometry), slow(kGeometry);
  const int cap = static_cast<int>(std::lround(weight_cap * TsdCell::kWeightOne));
  const support::Lidar lidar{.noise_m = 0.02};
  for (int scan = 0; scan < 30; ++scan) {
    const Pose2 T{near(random), near(random), turn(random)};
    // Some places are wrong: distances contradict each other.
    const Pose2 pushed = scan % 5 == 4 ? T * Pose2{0.2, 0.1, 0.05} : T;
    const auto pieces = extract_surface(scan_of(small_flat(), T, lidar, &random));
    const double trusted = scan % 3 == 0 ? 1.0 : weight(random);
    const Looks looks = scan % 2 == 0 ? Looks::dense : Looks::sparse;
    (void)updater.push(pieces, pushed, trusted, fast, looks);
    raster.draw(pieces, pushed, static_cast<float>(trusted));
    push_slowly(raster, looks, cap, slow);
  }
  ASSERT_EQ(fast.tiles(), slow.tiles());
  std::size_t known = 0;
  for (const TileIndex tile : fast.tiles()) {
    EXPECT_EQ(*fast.find(tile), *slow.find(tile));
    for (const TsdCell cell : *fast.find(tile)) known += cell.known() ? 1U : 0U;
  }
  EXPECT_GT(known, 10'000U);
}

INSTANTIATE_TEST_SUITE_P(SeedsAndCaps, PushLanes,
                         ::testing::Combine(::testing::Values(1U, 2U, 3U),
                                            ::testing::Values(1.0, 4.0, 32.0)));

}  // namespace
}  // namespace lifeline
