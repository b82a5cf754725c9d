// Matching recovers whatever motion the prediction allows for, in any scene.
#include <cmath>

#include <gtest/gtest.h>

#include "agents/slam/map_tracker.hpp"
#include "common/grid/tsd_update.hpp"
#include "tests/support/fine_grid.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {
namespace {

using support::scan_of;
using support::small_flat;

/// Mean squared robust error of a scan at a pose, straight from the field: what align() minimises.
double slow_cost(const TsdView& view, std::span<const SurfacePiece> pieces, const Pose2& T) {
  double cost = 0.0;
  for (const SurfacePiece& piece : pieces) {
    const Eigen::Vector2d p = T * piece.point.cast<double>();
    const Pose2 v = view.to_view({p.x(), p.y(), 0.0});
    TsdView::Sample sample{};
    if (!view.sample(static_cast<float>(v.x_m), static_cast<float>(v.y_m), sample)) continue;
    const double r = static_cast<double>(sample.value) * kGeometry.truncation_m / 0.04;
    cost += r * r / (1.0 + r * r);
  }
  return cost;
}

class MatchProperty : public ::testing::TestWithParam<unsigned> {};

TEST_P(MatchProperty, ARandomMotionIsRecovered) {
  std::mt19937 random(GetParam());
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> x(-1.2, 1.2), turn(-M_PI, M_PI);
  WorkingMap map(kGeometry);
  TsdUpdater updater(kGeometry, {});
  for (int i = 0; i < 6; ++i) {
    const Pose2 T{x(random), x(random), turn(random)};
    (void)updater.push(extract_surface(scan_of(small_flat(), T)), T, 1.0, map.own());
  }
  TsdView view;
  view.assign(map, {0.0, 0.0}, 20.0);
  MapTracker tracker({}, {}, {});
  const support::Lidar lidar{.noise_m = 0.01};
  for (int i = 0; i < 10; ++i) {
    const Pose2 truth{x(random), x(random), turn(random)};
    const Prediction prediction{
        {truth.x_m + 0.25 * normal(random), truth.y_m + 0.25 * normal(random),
         normalise_angle(truth.yaw_rad + 0.1 * normal(random))},
        0.25,
        0.1};
    const auto pieces = extract_surface(scan_of(small_flat(), truth, lidar, &random));
    const MatchResult result = tracker.match(map, view, pieces, prediction).front().match;
    EXPECT_EQ(result.verdict, Verdict::accepted);
    EXPECT_LT((result.T_map_head.translation() - truth.translation()).norm(), 0.015);
    EXPECT_LT(std::abs(normalise_angle(result.T_map_head.yaw_rad - truth.yaw_rad)), 0.006);
    // No better place close by, by a measure that knows nothing of gradients.
    const double found = slow_cost(view, pieces, result.T_map_head);
    for (const Pose2& off : {Pose2{0.02, 0.0, 0.0}, Pose2{-0.02, 0.0, 0.0}, Pose2{0.0, 0.02, 0.0},
                             Pose2{0.0, -0.02, 0.0}, Pose2{0.0, 0.0, 0.01}, Pose2{0, 0, -0.01}}) {
      EXPECT_LE(found, slow_cost(view, pieces, result.T_map_head * off) + 0.2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MatchProperty, ::testing::Values(1U, 2U, 3U, 4U));

}  // namespace
}  // namespace lifeline::slam
