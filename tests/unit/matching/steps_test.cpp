// The steps of the paper's sections 3.2 and 3.3, each on its own.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "coordinator/matching/hough_spectrum.hpp"
#include "coordinator/matching/overlap.hpp"
#include "coordinator/matching/preprocess.hpp"
#include "tests/support/drawn_building.hpp"

namespace lifeline::matching {
namespace {

// Rows from above: '#' occupied, '.' free, ' ' unknown.
OccupancyGrid picture(const std::vector<std::string>& rows) {
  OccupancyGrid grid;
  grid.columns = static_cast<int>(rows.front().size());
  grid.rows = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) {
      grid.cells.push_back(c == '#'   ? Occupancy::occupied
                           : c == '.' ? Occupancy::free
                                      : Occupancy::unknown);
    }
  }
  return grid;
}

TEST(PreprocessTest, ALoneOccupiedCellIsOutvoted) {
  const OccupancyGrid grid = filter_noise(picture({".....", ".....", "..#..", ".....", "....."}));
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), Occupancy::occupied), 0);
}

TEST(PreprocessTest, AWallIsKeptAndAugmented) {
  const OccupancyGrid grid = filter_noise(picture({".....", ".....", "#####", ".....", "....."}));
  for (int column = 1; column < 4; ++column) {
    EXPECT_EQ(grid.at(column, 2), Occupancy::occupied);
    EXPECT_EQ(grid.at(column, 1), Occupancy::occupied);
    EXPECT_EQ(grid.at(column, 0), Occupancy::free);
  }
}

TEST(PreprocessTest, BordersBetweenFreeAndUnknownBecomeOccupied) {
  const OccupancyGrid grid = close_borders(picture({"   ..", "   ..", "   .."}));
  EXPECT_EQ(grid.at(3, 1), Occupancy::occupied);
  EXPECT_EQ(grid.at(4, 1), Occupancy::free);
  EXPECT_EQ(grid.at(2, 1), Occupancy::unknown);
}

TEST(OverlapTest, AMapOnItselfAgreesWholly) {
  const OccupancyGrid grid = picture({"...#", "..# ", "##  "});
  const Overlap overlap = count_overlap(grid, grid, {});
  EXPECT_EQ(overlap.agreeing, 9U);
  EXPECT_EQ(overlap.disagreeing, 0U);
  EXPECT_DOUBLE_EQ(overlap.acceptance_index(), 1.0);
  EXPECT_DOUBLE_EQ(overlap.s_overlapping(360'000), 9.0 / 360'000);
}

TEST(OverlapTest, UnknownNeverAgreesWithUnknown) {
  const OccupancyGrid unknown = picture({"    ", "    "});
  const Overlap overlap = count_overlap(unknown, unknown, {});
  EXPECT_EQ(overlap.agreeing, 0U);
  EXPECT_DOUBLE_EQ(overlap.acceptance_index(), 0.0);
}

TEST(OverlapTest, AWallInTheOthersFreeSpaceDisagrees) {
  const Overlap overlap = count_overlap(picture({"...."}), picture({".#.#"}), {});
  EXPECT_EQ(overlap.agreeing, 2U);
  EXPECT_EQ(overlap.disagreeing, 2U);
  EXPECT_DOUBLE_EQ(overlap.acceptance_index(), 0.5);
}

TEST(HoughSpectrumTest, TurnsWithTheMapAndDoesNotCareWhereItLies) {
  const auto spectrum = [](const Pose2& T_world_map) {
    return hough_spectrum(test::draw_map(test::uneven_building(), T_world_map, 24.0));
  };
  const Spectrum still = spectrum({6.0, 1.0, 0.0}), moved = spectrum({7.0, 2.0, 0.0}),
                 turned = spectrum({6.0, 1.0, -30.0 * std::numbers::pi / 180.0});
  const auto best_turn = [](const Spectrum& a, const Spectrum& b) {
    return circular_maxima(circular_correlation(a, b), 10, 1).front().bin;
  };
  EXPECT_NEAR(std::remainder(best_turn(moved, still), 180.0 * kSpectrumBinsPerDegree), 0.0, 1.0);
  EXPECT_NEAR(best_turn(turned, still), 30.0 * kSpectrumBinsPerDegree, 1.0);
}

TEST(HoughSpectrumTest, OfAnEmptyMapIsZero) {
  const Spectrum spectrum = hough_spectrum(picture({"..", ".."}));
  EXPECT_EQ(std::accumulate(spectrum.begin(), spectrum.end(), 0.0), 0.0);
}

}  // namespace
}  // namespace lifeline::matching
