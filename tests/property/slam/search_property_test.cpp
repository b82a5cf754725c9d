// The searches' fast sums and looks against slow ones.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "agents/slam/correlative_search.hpp"
#include "agents/slam/fit_field.hpp"
#include "common/grid/tsd_update.hpp"
#include "common/grid/tsd_view.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {
namespace {

using support::scan_of;
using support::small_flat;

class SearchProperty : public ::testing::TestWithParam<unsigned> {
 protected:
  SearchProperty() : random(GetParam()) {
    TsdUpdater updater(kGeometry, {});
    for (int i = 0; i < 6; ++i) {
      const Pose2 T = random_pose();
      (void)updater.push(extract_surface(scan_of(small_flat(), T)), T, 1.0, map.own());
    }
  }
  Pose2 random_pose() {
    std::uniform_real_distribution<double> near(-1.2, 1.2), turn(-M_PI, M_PI);
    return {near(random), near(random), turn(random)};
  }
  /// A scan of few points, so that none is left out.
  std::vector<SurfacePiece> pieces_at(const Pose2& T) {
    const support::Lidar lidar{.beams = 90, .step_rad = M_PI / 45.0, .noise_m = 0.01};
    return extract_surface(scan_of(small_flat(), T, lidar, &random));
  }

  std::mt19937 random;
  WorkingMap map{kGeometry};
};

TEST_P(SearchProperty, FourSamplesAreFourTimesOneToTheBit) {
  TsdView view;
  view.assign(map, {0.0, 0.0}, 12.0);
  const Pose2 middle = view.to_view({0.0, 0.0, 0.0});
  std::uniform_real_distribution<float> off(-300.0F, 300.0F);
  std::size_t known = 0;
  for (int i = 0; i < 5000; ++i) {
    FloatLanes x{}, y{};
    for (int k = 0; k < kLanes; ++k) {
      x[k] = static_cast<float>(middle.x_m) + off(random);
      y[k] = static_cast<float>(middle.y_m) + off(random);
      if (i % 10 == 0) x[k] = 64.0F * std::round(x[k] / 64.0F) + 0.25F;  // between two tiles
      if (i % 15 == 0) y[k] = 64.0F * std::round(y[k] / 64.0F) - 0.25F;
    }
    const auto four = view.sample_four(x, y);
    for (int k = 0; k < kLanes; ++k) {
      TsdView::Sample one{};
      const bool is_known = view.sample(x[k], y[k], one);
      ASSERT_EQ(four.known[k] != 0, is_known);
      if (!is_known) continue;
      ++known;
      EXPECT_EQ(four.value[k], one.value);
      EXPECT_EQ(four.gradient_x[k], one.gradient.x());
      EXPECT_EQ(four.gradient_y[k], one.gradient.y());
    }
  }
  EXPECT_GT(known, 500U);
}

TEST_P(SearchProperty, ABlocksBoundIsTheSumOfItsPointsAndNoPlaceScoresMore) {
  FitField field;
  field.assign(map, {});
  std::uniform_int_distribution<int> off(-60, 60);
  std::vector<FitField::Place> offsets(40);
  for (auto& offset : offsets) offset = {off(random), off(random)};
  const auto score = [&](int level, FitField::Place from) {
    int sum = 0;
    for (const auto& offset : offsets) {
      const FitField::Place at{from.column + offset.column, from.row + offset.row};
      if (field.contains(at)) sum += field.fit(level, at);
    }
    return sum;
  };
  std::vector<std::int16_t> bounds;
  field.bound_blocks(offsets, bounds);
  std::size_t compared = 0;
  for (std::size_t block = 0; block < bounds.size(); ++block) {
    if (!field.has_free_place(block)) continue;
    ++compared;
    const FitField::Place corner = field.corner_of(block);
    EXPECT_EQ(bounds[block], score(FitField::kLevels - 1, corner));
    for (int y = 0; y < FitField::kBlock; ++y) {
      for (int x = 0; x < FitField::kBlock; ++x) {
        EXPECT_GE(bounds[block], score(0, {corner.column + x, corner.row + y}));
      }
    }
  }
  EXPECT_GT(compared, 20U);
}

/// How well a point fits: the best of the known cells of its square of 2 x 2.
double slow_fit(const TsdGrid& grid, const Eigen::Vector2d& p, double free_penalty) {
  const CellIndex corner{2 * static_cast<std::int32_t>(std::floor(p.x() / 0.1)),
                         2 * static_cast<std::int32_t>(std::floor(p.y() / 0.1))};
  std::optional<double> best;
  for (const CellIndex i : {corner,
                            CellIndex{corner.x + 1, corner.y},
                            CellIndex{corner.x, corner.y + 1},
                            {corner.x + 1, corner.y + 1}}) {
    const TsdCell cell = grid.cell(i);
    if (!cell.known()) continue;
    // In steps of 1 %, as the search has them.
    const int loss = 100 * std::abs(int{cell.tsd}) / TsdCell::kTsdOne;
    const bool is_free = cell.tsd > TsdCell::kTsdOne * 95 / 100;
    best = std::max(best.value_or(-free_penalty), is_free ? -free_penalty : 0.01 * (100 - loss));
  }
  return best.value_or(0.0);
}

TEST_P(SearchProperty, ACandidatesAgreementIsTheMeanFitOfItsPoints) {
  CorrelativeSearch search({});
  for (int trial = 0; trial < 5; ++trial) {
    const Pose2 truth = random_pose();
    const auto pieces = pieces_at(truth);
    ASSERT_LT(pieces.size(), 150U);
    const auto found = search.search(map, pieces, {truth * Pose2{0.3, -0.2, 0.1}, 0.3, 0.1});
    ASSERT_FALSE(found.empty());
    for (const SearchCandidate& candidate : found) {
      double sum = 0.0;
      for (const SurfacePiece& piece : pieces) {
        sum += slow_fit(map.own(), candidate.T_map_head * piece.point.cast<double>(), 0.4);
      }
      EXPECT_NEAR(candidate.agreement, sum / static_cast<double>(pieces.size()), 0.02);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SearchProperty, ::testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace lifeline::slam
