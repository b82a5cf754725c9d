// The parts of the paper's path: nearest neighbours, RANSAC, ICP, Algorithm 1 and GICP.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "agents/slam/failure_detector.hpp"
#include "agents/slam/gicp_matcher.hpp"
#include "agents/slam/icp_matcher.hpp"
#include "agents/slam/point_grid.hpp"
#include "agents/slam/ransac_matcher.hpp"
#include "tests/support/flat_world.hpp"
#include "tests/support/poses.hpp"

namespace lifeline::slam {
namespace {

PointSet seen_from(const Pose2& T_world_head) {
  return to_points(extract_surface(support::scan_of(support::small_flat(), T_world_head)));
}

/// What a scan from `T_world_head` shows, in world coordinates.
PointSet in_world(const Pose2& T_world_head) {
  PointSet set = seen_from(T_world_head);
  const Pose2 turn{0.0, 0.0, T_world_head.yaw_rad};
  for (auto& p : set.points) p = T_world_head * p;
  for (auto& n : set.normals) n = turn * n;
  return set;
}

TEST(PointGrid, FindsWhatAFullSearchFinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-3.0, 3.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(anywhere(random), anywhere(random));
  const PointGrid grid(points, 0.4);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(1.2 * anywhere(random), 1.2 * anywhere(random));
    double best_m = 0.3;
    for (const auto& q : points) best_m = std::min(best_m, (q - p).norm());
    const auto found = grid.nearest(p, 0.3);
    EXPECT_EQ(found.has_value(), best_m < 0.3);
    if (!found) continue;
    EXPECT_DOUBLE_EQ(found->distance_m, best_m);
    EXPECT_DOUBLE_EQ((points[found->index] - p).norm(), best_m);
  }
}

TEST(PointGrid, IsEmptyWithoutPoints) {
  const PointGrid grid({}, 0.4);
  EXPECT_EQ(grid.size(), 0U);
  EXPECT_FALSE(grid.nearest({0.0, 0.0}, 0.4));
}

TEST(PointGrid, KeepsItsMemoryBoundedWhenPointsLieFarApart) {
  const std::vector<Eigen::Vector2d> points{{0.0, 0.0}, {1e9, 1e9}};
  const PointGrid grid(points, 0.4);
  EXPECT_TRUE(grid.nearest({0.1, 0.1}, 0.4));
  EXPECT_TRUE(grid.nearest({1e9, 1e9 - 0.1}, 0.4));
  EXPECT_FALSE(grid.nearest({5e8, 5e8}, 0.4));
}

TEST(PointGrid, LeavesOutWhatIsNoPlaceAtAll) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector2d> points{
      {kNan, 0.0}, {1.0, 1.0}, {0.0, kInfinite}, {-1e308, 1e308}, {2.0, 1.0}};
  const PointGrid grid(points, 0.4);
  EXPECT_EQ(grid.size(), 2U);
  const auto found = grid.nearest({1.9, 1.0}, 0.4);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->index, 4U);
  EXPECT_FALSE(grid.nearest({kNan, 1.0}, 0.4));
  EXPECT_FALSE(grid.nearest({kInfinite, 1.0}, 0.4));
  EXPECT_FALSE(PointGrid(std::vector<Eigen::Vector2d>{{kNan, kNan}}, 0.4).nearest({0.0, 0.0}, 0.4));
}

TEST(PointGrid, FindsInWiderBinsWhatAFullSearchFinds) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::vector<Eigen::Vector2d> points;
  for (const double centre_m : {0.0, 1e3, -1e6, 1e8}) {
    for (int i = 0; i < 100; ++i) {
      points.emplace_back(centre_m + anywhere(random), centre_m + anywhere(random));
    }
  }
  const PointGrid grid(points, 0.4);
  for (const auto& near : points) {
    const Eigen::Vector2d p = near + 0.3 * Eigen::Vector2d(anywhere(random), anywhere(random));
    double best_m = 0.4;
    for (const auto& q : points) best_m = std::min(best_m, (q - p).norm());
    const auto found = grid.nearest(p, 0.4);
    EXPECT_EQ(found.has_value(), best_m < 0.4);
    if (found) {
      EXPECT_DOUBLE_EQ(found->distance_m, best_m);
    }
  }
}

TEST(IcpMatcher, RecoversASmallMotionWellBelowTheSpacingOfThePoints) {
  const Pose2 truth{0.3, 0.2, 0.1};
  const PointSet model = in_world({0.25, 0.2, 0.0}), scan = seen_from(truth);
  const IcpMatcher icp({});
  const PointGrid index(model.points, icp.config().first_gate_m);
  const Pose2 found = icp.match(index, model, scan, {0.2, 0.27, 0.06});
  EXPECT_LT(apart_m(found, truth), 0.02);
  EXPECT_LT(apart_rad(found, truth), 0.009);  // half of the angle between two beams
}

TEST(IcpMatcher, StaysWhereItIsWithoutPairs) {
  const PointSet model = in_world({});
  PointSet two = seen_from({});
  two.points.resize(2);
  two.normals.resize(2);
  const IcpMatcher icp({});
  const Pose2 start{1.0, 2.0, 3.0};
  EXPECT_EQ(apart_m(icp.match(PointGrid(model.points, 0.4), model, two, start), start), 0.0);
  const PointSet none;
  EXPECT_EQ(apart_m(icp.match(PointGrid(none.points, 0.4), none, model, start), start), 0.0);
}

TEST(RansacMatcher, ComesCloseFromFarOff) {
  const Pose2 truth{0.3, 0.2, 0.3};
  const PointSet model = in_world({}), scan = seen_from(truth);
  const RansacMatcher ransac({});
  const PointGrid index(model.points, 0.4);
  const Prediction off{{0.0, -0.2, 0.0}, 0.3, 0.2};
  const Pose2 found = ransac.match(index, model, scan, off);
  EXPECT_LT(apart_m(found, truth), 0.3);
  EXPECT_LT(apart_rad(found, truth), 0.1);
  const Pose2 fine = IcpMatcher({}).match(index, model, scan, found);
  EXPECT_LT(apart_m(fine, truth), 0.03);
}

TEST(RansacMatcher, IsDeterministicAndKeepsToTheWindow) {
  const PointSet model = in_world({}), scan = seen_from({0.3, 0.2, 0.3});
  const RansacMatcher ransac({});
  const PointGrid index(model.points, 0.4);
  const Prediction tight{{0.3, 0.2, 0.3}, 0.05, 0.01};
  const Pose2 once = ransac.match(index, model, scan, tight);
  const Pose2 again = ransac.match(index, model, scan, tight);
  EXPECT_EQ(once.x_m, again.x_m);
  EXPECT_EQ(once.yaw_rad, again.yaw_rad);
  EXPECT_LE(apart_m(once, tight.T_map_head), 0.3);
  EXPECT_LE(apart_rad(once, tight.T_map_head), 0.05);
}

TEST(RansacMatcher, KeepsThePredictionWithoutAModel) {
  const PointSet none, scan = seen_from({});
  const Prediction prediction{{1.0, 2.0, 0.5}, 0.1, 0.1};
  const Pose2 found = RansacMatcher({}).match(PointGrid(none.points, 0.4), none, scan, prediction);
  EXPECT_EQ(apart_m(found, prediction.T_map_head), 0.0);
}

TEST(FailureDetector, TheMeanDoesNotGrowWithTheNumberOfPoints) {
  const FailureDetector detector({});
  PointSet few, many;
  for (int i = 0; i < 40; ++i) few.points.emplace_back(i, 0.0);
  for (int i = 0; i < 4000; ++i) many.points.emplace_back(0.5 * i, 0.0);
  const Pose2 beside{0.0, 0.05, 0.0};
  EXPECT_NEAR(detector.measure(few, few, beside).mean_error_m, 0.05, 1e-9);
  EXPECT_NEAR(detector.measure(many, many, beside).mean_error_m, 0.05, 1e-9);
  EXPECT_FALSE(detector.detect(detector.measure(few, few, beside)));
  EXPECT_FALSE(detector.detect(detector.measure(many, many, beside)));
}

TEST(FailureDetector, FailsOnLargeErrorsFewPairsAndNoModel) {
  const FailureDetector detector({});
  EXPECT_TRUE(detector.detect({100, 0.081}));
  EXPECT_FALSE(detector.detect({100, 0.08}));
  EXPECT_FALSE(detector.detect({20, 0.001}));
  EXPECT_TRUE(detector.detect({19, 0.001}));
  const PointSet none, scan = seen_from({});
  const MatchError error = detector.measure(none, scan, {});
  EXPECT_EQ(error.model_points, 0);
  EXPECT_TRUE(detector.detect(error));
  EXPECT_TRUE(detector.detect(detector.measure(scan, none, {})));
}

TEST(FailureDetector, SeesASceneThatIsNotTheModel) {
  support::FlatWorld other;
  other.add_box(-1.4, -1.1, 3.1, 2.2);
  const PointSet scan = to_points(extract_surface(support::scan_of(other, {})));
  const FailureDetector detector({});
  EXPECT_TRUE(detector.detect(detector.measure(in_world({}), scan, {})));
}

TEST(GicpMatcher, AlignsTwoScansFromTheStartOfEquation5) {
  const Pose2 before{0.2, 0.1, 0.1}, now{0.45, 0.2, 0.3};
  const Pose2 truth = before.inverse() * now;
  const Pose2 start{0.15, 0.0, 0.17};
  const Pose2 found = GicpMatcher({}).match(seen_from(before), seen_from(now), start);
  EXPECT_LT(apart_m(found, truth), 0.02);
  EXPECT_LT(apart_rad(found, truth), 0.005);
}

TEST(GicpMatcher, PlanarCovariancesLetAWallSlideAlongItself) {
  // Two looks at one straight wall whose ends are not seen: across it the motion is known, along it
  // the start stands.
  const support::FlatWorld wall = support::FlatWorld().add(2.0, -50.0, 2.0, 50.0);
  const support::Lidar lidar{.beams = 91, .first_angle_rad = -M_PI / 4, .step_rad = M_PI / 180};
  const PointSet before = to_points(extract_surface(support::scan_of(wall, {}, lidar)));
  const PointSet now = to_points(extract_surface(support::scan_of(wall, {0.1, 0.3, 0.0}, lidar)));
  const Pose2 found = GicpMatcher({}).match(before, now, {0.0, 0.3, 0.0});
  EXPECT_NEAR(found.x_m, 0.1, 0.01);
  EXPECT_NEAR(found.y_m, 0.3, 0.1);
}

TEST(GicpMatcher, ReturnsTheStartForScansTooPoor) {
  PointSet poor = seen_from({});
  poor.points.resize(5);
  poor.normals.resize(5);
  const Pose2 start{0.1, 0.2, 0.3};
  EXPECT_EQ(apart_m(GicpMatcher({}).match(poor, seen_from({}), start), start), 0.0);
  EXPECT_EQ(apart_m(GicpMatcher({}).match(seen_from({}), {}, start), start), 0.0);
}

}  // namespace
}  // namespace lifeline::slam
