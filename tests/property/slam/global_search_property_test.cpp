// The search of a whole map against slow ones.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "agents/slam/fit_field.hpp"
#include "agents/slam/global_search.hpp"
#include "tests/property/slam/mapped_flat.hpp"
#include "tests/support/whole_search.hpp"

namespace lifeline::slam {
namespace {

class WholeMapSearch : public MappedFlat {};

using Place = FitField::Place;

int slow_score(const FitField& field, std::span<const Place> offsets, Place head) {
  int sum = 0;
  for (const Place& offset : offsets) {
    const Place at{head.column + offset.column, head.row + offset.row};
    if (field.contains(at)) sum += field.fit(0, at);
  }
  return sum;
}

/// Point by point the best of its block, wherever in the block its head may be.
int slow_bound(const FitField& field, std::span<const Place> offsets, Place corner) {
  int sum = 0;
  for (const Place& offset : offsets) {
    int best = std::numeric_limits<int>::min();
    for (int i = 0; i < FitField::kBlock * FitField::kBlock; ++i) {
      const Place at{corner.column + offset.column + i % FitField::kBlock,
                     corner.row + offset.row + i / FitField::kBlock};
      best = std::max(best, field.contains(at) ? field.fit(0, at) : 0);
    }
    sum += best;
  }
  return sum;
}

TEST_P(WholeMapSearch, ABlocksBoundIsTheSumOfItsPointsBestAndNoPlaceScoresMore) {
  FitField field;
  support::take_map(field, map);
  std::uniform_int_distribution<int> off(-60, 60);
  std::vector<Place> offsets(40);
  for (Place& offset : offsets) offset = {off(random), off(random)};
  offsets.push_back({-FitField::kReach, FitField::kReach});
  std::vector<FitField::BlockBound> bounds;
  SearchWork work = 0;
  field.bound_blocks(offsets, field.blocks(), -1000, bounds, work);
  EXPECT_LT(work, 0);
  EXPECT_GT(bounds.size(), 20U);
  for (const auto& [block, bound] : bounds) {
    const Place corner = field.corner_of(block);
    EXPECT_EQ(bound, slow_bound(field, offsets, corner));
    for (int y = 0; y < FitField::kBlock; ++y) {
      for (int x = 0; x < FitField::kBlock; ++x) {
        EXPECT_GE(bound, slow_score(field, offsets, {corner.column + x, corner.row + y}));
      }
    }
  }
}

TEST_P(WholeMapSearch, BlocksAreBoundedThatAreAmongThoseAskedForAndReachTheLeast) {
  FitField field;
  support::take_map(field, map);
  std::uniform_int_distribution<int> off(-30, 30);
  std::vector<Place> offsets(40);
  for (Place& offset : offsets) offset = {off(random), off(random)};
  std::vector<FitField::BlockBound> all, some;
  SearchWork work = 0;
  field.bound_blocks(offsets, field.blocks(), -1000, all, work);
  const Eigen::Vector2d centre(0.6, -0.4);
  const double radius_m = 1.1;
  const FitField::Blocks around = field.blocks_around(centre, radius_m);
  const int least = 150;
  field.bound_blocks(offsets, around, least, some, work);
  EXPECT_LT(some.size(), all.size());
  for (const auto& [block, bound] : all) {
    const Place corner = field.corner_of(block);
    const Eigen::Vector2d low = field.centre_of(corner);
    const Eigen::Vector2d high =
        field.centre_of({corner.column + FitField::kBlock - 1, corner.row + FitField::kBlock - 1});
    const double apart_m = (centre.cwiseMax(low).cwiseMin(high) - centre).norm();
    if (apart_m > radius_m || bound < least) continue;
    EXPECT_TRUE(std::any_of(some.begin(), some.end(),
                            [block = block](const auto& found) { return found.block == block; }));
  }
  for (const auto& found : some) EXPECT_GE(found.bound, least);
}

TEST_P(WholeMapSearch, AMapTakenInPiecesIsTheSame) {
  FitField whole, pieces;
  support::take_map(whole, map);
  pieces.begin(map, {});
  EXPECT_GT(support::advance_all([&](SearchWork& work) { return pieces.advance(map, work); }, 1),
            100);
  const FitField::Blocks all = whole.blocks();
  for (std::int32_t row = 0; row < all.high * FitField::kBlock; ++row) {
    for (std::int32_t column = 0; column < all.right * FitField::kBlock; ++column) {
      const Place here{column, row};
      ASSERT_EQ(pieces.is_free(here), whole.is_free(here));
      for (int level = 0; level + 1 < FitField::kLevels; ++level) {
        ASSERT_EQ(pieces.fit(level, here), whole.fit(level, here));
      }
    }
  }
}

/// Every place where a head that sees `points` may stand and the fit is good enough, best first.
std::vector<GlobalCandidate> slow_search(const FitField& field,
                                         std::span<const Eigen::Vector2d> points,
                                         const GlobalSearchConfig& config) {
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points.size()));
  const double step_rad = std::clamp(1.5 * field.spacing_m() / lever_m, 0.01, 0.06);
  const int yaws = static_cast<int>(std::ceil(M_PI / step_rad));
  const double full = FitField::kFull * static_cast<double>(points.size());
  const FitField::Blocks all = field.blocks();
  std::vector<GlobalCandidate> found;
  for (int k = -yaws; k <= yaws; ++k) {
    const double c = std::cos(k * step_rad) / field.spacing_m();
    const double s = std::sin(k * step_rad) / field.spacing_m();
    std::vector<Place> offsets;
    for (const Eigen::Vector2d& p : points) {
      offsets.push_back({static_cast<std::int32_t>(std::floor(0.5 + c * p.x() - s * p.y())),
                         static_cast<std::int32_t>(std::floor(0.5 + s * p.x() + c * p.y()))});
    }
    for (std::int32_t row = 0; row < all.high * FitField::kBlock; ++row) {
      for (std::int32_t column = 0; column < all.right * FitField::kBlock; ++column) {
        if (!field.is_free({column, row})) continue;
        const double agreement = slow_score(field, offsets, {column, row}) / full;
        if (agreement < config.min_agreement) continue;
        const Eigen::Vector2d at_m = field.centre_of({column, row});
        found.push_back({{at_m.x(), at_m.y(), normalise_angle(k * step_rad)}, agreement});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.agreement > b.agreement; });
  return found;
}

/// Sums are whole numbers; only their share of the most is rounded.
constexpr double kRounding = 1e-9;

TEST_P(WholeMapSearch, FindsWhatASlowOneFindsHoweverItsWorkIsDivided) {
  const GlobalSearchConfig config;
  FitField field;
  support::take_map(field, map);
  GlobalSearch search(config);
  support::take_map(search, map);
  for (int trial = 0; trial < 3; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (const SurfacePiece& piece : pieces_at(random_pose())) {
      points.push_back(piece.point.cast<double>());
    }
    ASSERT_LE(points.size(), static_cast<std::size_t>(config.max_points));
    const auto slow = slow_search(field, points, config);
    const auto fast = support::search_all(search, points, 0.0, M_PI);
    ASSERT_FALSE(slow.empty());
    ASSERT_FALSE(fast.candidates.empty());
    EXPECT_NEAR(fast.candidates.front().agreement, slow.front().agreement, kRounding);
    for (const GlobalCandidate& place : slow) {
      if (!fast.complete || place.agreement < slow.front().agreement - config.margin + 0.01) break;
      EXPECT_TRUE(std::any_of(fast.candidates.begin(), fast.candidates.end(),
                              [&](const GlobalCandidate& found) {
                                const Pose2 apart = found.T_map_head.inverse() * place.T_map_head;
                                return found.agreement >= place.agreement - kRounding &&
                                       apart.translation().norm() < 2.0 * config.apart_m &&
                                       std::abs(apart.yaw_rad) < 2.0 * config.apart_rad;
                              }))
          << place.T_map_head.x_m << " " << place.T_map_head.y_m;
    }

    search.begin(points, 0.0, M_PI);
    EXPECT_GT(support::advance_all([&](SearchWork& work) { return search.advance(work); }, 1), 100);
    const auto divided = search.result();
    EXPECT_EQ(divided.complete, fast.complete);
    ASSERT_EQ(divided.candidates.size(), fast.candidates.size());
    for (std::size_t i = 0; i < fast.candidates.size(); ++i) {
      EXPECT_EQ(divided.candidates[i].T_map_head.translation(),
                fast.candidates[i].T_map_head.translation());
      EXPECT_EQ(divided.candidates[i].T_map_head.yaw_rad, fast.candidates[i].T_map_head.yaw_rad);
      EXPECT_EQ(divided.candidates[i].agreement, fast.candidates[i].agreement);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, WholeMapSearch, ::testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace lifeline::slam
