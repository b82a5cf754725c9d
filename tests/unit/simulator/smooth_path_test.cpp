#include "agents/sources/simulator/smooth_path.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/route_finder.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

class SmoothPathTest : public ::testing::Test {
 protected:
  SmoothPathTest() : space_(FreeSpace::make(support::two_rooms(0.9)).value()) {}

  std::vector<std::size_t> way(Eigen::Vector2d from, Eigen::Vector2d to) const {
    RouteFinder routes(space_);
    const std::size_t start = space_.index(space_.cell_at(from));
    routes.spread(std::span(&start, 1), [](std::size_t, double) { return true; });
    return routes.way_to(space_.index(space_.cell_at(to)));
  }

  FreeSpace space_;
};

TEST_F(SmoothPathTest, AWayAcrossAnOpenRoomBecomesOneStraightPiece) {
  const auto corners = pull_straight(space_, way({1.0, 1.0}, {3.0, 2.6}));
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_LT((corners.front() - Eigen::Vector2d(1.0, 1.0)).norm(), 0.05);
  EXPECT_LT((corners.back() - Eigen::Vector2d(3.0, 2.6)).norm(), 0.05);
}

TEST_F(SmoothPathTest, AWayThroughADoorwayKeepsItsDistance) {
  const auto corners = pull_straight(space_, way({1.0, 0.6}, {7.0, 0.6}));
  ASSERT_GE(corners.size(), 3U);
  EXPECT_LE(corners.size(), 10U);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    EXPECT_TRUE(space_.can_go(corners[i - 1], corners[i]));
  }
}

TEST_F(SmoothPathTest, AWayOfOneCellIsItself) {
  const std::vector<std::size_t> here{space_.index(space_.cell_at({1.0, 1.0}))};
  EXPECT_EQ(pull_straight(space_, here).size(), 1U);
}

TEST_F(SmoothPathTest, CornersAreRoundedOverWalkableFloor) {
  const std::vector<Eigen::Vector2d> corners{{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}};
  const SmoothPath path(space_, corners);

  EXPECT_EQ(path.at(0.0), corners.front());
  EXPECT_EQ(path.at(path.length_m()), corners.back());
  EXPECT_LT(path.length_m(), 3.9);
  double sharpest = 0.0;
  for (double s = 0.1; s + 0.1 < path.length_m(); s += 0.05) {
    EXPECT_TRUE(space_.is_walkable(space_.cell_at(path.at(s))));
    const Eigen::Vector2d in = path.at(s) - path.at(s - 0.1), out = path.at(s + 0.1) - path.at(s);
    sharpest = std::max(sharpest, std::acos(std::min(1.0, in.dot(out) / in.norm() / out.norm())));
  }
  EXPECT_LT(sharpest, 25.0 * std::numbers::pi / 180.0);
}

TEST_F(SmoothPathTest, PlacesAlongItAreAsFarApartAsTheyAreCalled) {
  const std::vector<Eigen::Vector2d> corners{{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {1.0, 3.0}};
  const SmoothPath path(space_, corners);
  double length_m = 0.0;
  for (double s = 0.0; s < path.length_m(); s += 0.01) {
    const double step_m = (path.at(s + 0.01) - path.at(s)).norm();
    EXPECT_LE(step_m, 0.01 + 1e-9);
    length_m += step_m;
  }
  EXPECT_NEAR(length_m, path.length_m(), 0.01 * path.length_m());
}

TEST_F(SmoothPathTest, IsSlowInCurvesFastOnTheStraightAndStopsAtTheEnd) {
  const std::vector<Eigen::Vector2d> corners{{0.6, 0.6}, {3.4, 0.6}, {3.4, 3.4}};
  const SmoothPath path(space_, corners);

  EXPECT_DOUBLE_EQ(path.speed_limit_m_s(path.length_m()), 0.0);
  EXPECT_GT(path.speed_limit_m_s(0.5), 1.0);
  EXPECT_LT(path.speed_limit_m_s(0.5 * path.length_m()), 1.0);
  EXPECT_GT(path.speed_limit_m_s(0.5 * path.length_m()), 0.2);
  for (double s = 0.0; s + 0.05 < path.length_m(); s += 0.05) {
    // What has to be lost until the next place can be lost at 0.8 m/s^2.
    const double here = path.speed_limit_m_s(s), next = path.speed_limit_m_s(s + 0.05);
    EXPECT_LE(here * here - next * next, 2.0 * 0.8 * 0.05 * 1.2 + 1e-9);
  }
}

TEST_F(SmoothPathTest, TurningBackIsDoneAlmostStanding) {
  const std::vector<Eigen::Vector2d> corners{{1.0, 1.0}, {3.0, 1.0}, {1.2, 1.0}};
  const SmoothPath path(space_, corners);
  EXPECT_NEAR(path.length_m(), 3.8, 1e-6);
  EXPECT_LT(path.speed_limit_m_s(2.0), 0.25);
}

TEST_F(SmoothPathTest, APathWithoutLengthStaysWhereItIs) {
  const std::vector<Eigen::Vector2d> corners{{1.0, 1.0}, {1.0, 1.0}};
  const SmoothPath path(space_, corners);
  EXPECT_DOUBLE_EQ(path.length_m(), 0.0);
  EXPECT_EQ(path.at(0.5), corners.front());
  EXPECT_DOUBLE_EQ(path.speed_limit_m_s(0.0), 0.0);
}

}  // namespace
}  // namespace lifeline::sources
