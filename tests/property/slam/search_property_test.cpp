// The searches' fast sums and looks against slow ones.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "agents/slam/correlative_search.hpp"
#include "agents/slam/direct_matcher.hpp"
#include "common/grid/tsd_view.hpp"
#include "tests/property/slam/mapped_flat.hpp"

namespace lifeline::slam {
namespace {

class SearchProperty : public MappedFlat {};

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

TEST_P(SearchProperty, FourCellsAreTheOnesThatAreThere) {
  TsdView view;
  view.assign(map, {0.3, -0.2}, 3.0);
  std::uniform_int_distribution<std::int32_t> at(-100, 300);
  std::size_t known = 0;
  for (int i = 0; i < 5000; ++i) {
    IntLanes x{}, y{};
    for (int k = 0; k < kLanes; ++k) {
      x[k] = at(random);
      y[k] = at(random);
    }
    const IntLanes four = view.four_cells(x, y);
    for (int k = 0; k < kLanes; ++k) {
      const TsdCell one = view.cell(x[k], y[k]);
      ASSERT_EQ(four[k], std::bit_cast<std::int32_t>(one));
      known += one.known() ? 1 : 0;
    }
  }
  EXPECT_GT(known, 500U);
}

/// Share of the points, by weight, that a surface stands before.
double slow_share_through_walls(const TsdView& view, std::span<const SurfacePiece> pieces,
                                const Pose2& T_map_head) {
  const double cell_m = view.geometry().cell_size_m;
  double sum = 0.0, weight = 0.0;
  for (const SurfacePiece& piece : pieces) {
    const double of_point = std::sqrt(std::clamp(piece.left_m + piece.right_m, 0.02F, 0.5F) / 0.2F);
    const double length_m = static_cast<double>(piece.point.norm());
    bool passes = false;
    for (double at_m = 2.0 * cell_m; at_m < length_m - 8.0 * cell_m; at_m += 2.0 * cell_m) {
      const Eigen::Vector2d p =
          T_map_head * (piece.point.cast<double>() * (at_m / length_m)).eval();
      const Pose2 at = view.to_view({p.x(), p.y(), 0.0});
      const TsdCell cell = view.cell(static_cast<std::int32_t>(std::floor(at.x_m)),
                                     static_cast<std::int32_t>(std::floor(at.y_m)));
      passes = passes || (cell.known() && cell.value() < -0.3F);
    }
    sum += passes ? of_point : 0.0;
    weight += of_point;
  }
  return sum / weight;
}

TEST_P(SearchProperty, BeamsThatPassThroughWallsAreCountedAsFarAsItMatters) {
  TsdView view;
  view.assign(map, {0.0, 0.0}, 12.0);
  std::uniform_real_distribution<double> share(0.0, 0.3);
  DirectMatcher direct({});
  int cut_short = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto pieces = pieces_at(random_pose());
    const Pose2 elsewhere = random_pose();
    direct.set_scan(pieces);
    const double all = direct.seen_through_walls(view, elsewhere);
    // A cell's edge may be on either side of a float.
    EXPECT_NEAR(all, slow_share_through_walls(view, pieces, elsewhere), 0.03);
    const double enough = share(random);
    const double some = direct.seen_through_walls(view, elsewhere, enough);
    if (all <= enough) {
      EXPECT_EQ(some, all);
    } else {
      EXPECT_GT(some, enough - 1e-6);
      EXPECT_LE(some, all);
      cut_short += some < all ? 1 : 0;
    }
  }
  EXPECT_GT(cut_short, 5);
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
