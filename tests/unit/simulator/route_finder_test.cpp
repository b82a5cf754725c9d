#include "agents/sources/simulator/route_finder.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

class RouteFinderTest : public ::testing::Test {
 protected:
  RouteFinderTest() : space_(FreeSpace::make(support::two_rooms(0.9)).value()), routes_(space_) {}

  std::size_t at(double x, double y) const { return space_.index(space_.cell_at({x, y})); }

  void spread_all(std::vector<std::size_t> starts) {
    routes_.spread(starts, [](std::size_t, double) { return true; });
  }

  FreeSpace space_;
  RouteFinder routes_;
};

TEST_F(RouteFinderTest, VisitsEveryWalkableCellOnceInOrderOfCost) {
  std::vector<int> visits(space_.size());
  double last = 0.0;
  const std::size_t start = at(1.0, 1.0);

  routes_.spread(std::span(&start, 1), [&](std::size_t cell, double cost) {
    ++visits[cell];
    EXPECT_GE(cost, last);
    last = cost;
    return true;
  });

  for (std::size_t i = 0; i < space_.size(); ++i) {
    EXPECT_EQ(visits[i], space_.is_walkable(space_.cell(i)) ? 1 : 0);
  }
}

TEST_F(RouteFinderTest, StopsWhenTold) {
  int visits = 0;
  const std::size_t start = at(1.0, 1.0);
  routes_.spread(std::span(&start, 1), [&](std::size_t, double) { return ++visits < 10; });
  EXPECT_EQ(visits, 10);
}

TEST_F(RouteFinderTest, TheWayGoesFromCellToCellThroughTheDoorway) {
  spread_all({at(1.0, 1.0)});
  const std::vector<std::size_t> way = routes_.way_to(at(7.0, 1.0));

  EXPECT_EQ(way.front(), at(1.0, 1.0));
  EXPECT_EQ(way.back(), at(7.0, 1.0));
  double length_m = 0.0;
  bool through_doorway = false;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const CellIndex cell = space_.cell(way[i]);
    EXPECT_TRUE(space_.is_walkable(cell));
    through_doorway |= (space_.centre(cell) - Eigen::Vector2d(4.05, 2.0)).norm() < 0.1;
    if (i == 0) continue;
    const CellIndex before = space_.cell(way[i - 1]);
    EXPECT_LE(std::max(std::abs(cell.x - before.x), std::abs(cell.y - before.y)), 1);
    length_m += (space_.centre(cell) - space_.centre(before)).norm();
  }
  EXPECT_TRUE(through_doorway);
  EXPECT_LT(length_m, 7.2) << "the straight pieces are 6.4 m";
}

TEST_F(RouteFinderTest, CostsAreMetresInTheOpen) {
  const std::size_t start = at(1.5, 2.0), goal = at(2.5, 2.0);
  double cost = 0.0;
  routes_.spread(std::span(&start, 1), [&](std::size_t cell, double cost_to) {
    if (cell == goal) cost = cost_to;
    return cell != goal;
  });
  EXPECT_NEAR(cost, 1.0, 1e-9);
}

TEST_F(RouteFinderTest, SeveralStartsShareTheFloor) {
  spread_all({at(1.0, 2.0), at(7.0, 2.0)});

  EXPECT_EQ(routes_.start_of(at(1.5, 3.0)), at(1.0, 2.0));
  EXPECT_EQ(routes_.start_of(at(6.0, 1.0)), at(7.0, 2.0));
  EXPECT_EQ(routes_.way_to(at(6.0, 1.0)).front(), at(7.0, 2.0));
}

TEST_F(RouteFinderTest, ASpreadForgetsTheOneBefore) {
  spread_all({at(1.0, 2.0)});
  spread_all({at(7.0, 2.0)});
  EXPECT_EQ(routes_.start_of(at(1.5, 3.0)), at(7.0, 2.0));
}

TEST_F(RouteFinderTest, KeepsToTheMiddleOfADoorwayRatherThanToItsJamb) {
  spread_all({at(3.0, 1.7)});
  for (const std::size_t cell : routes_.way_to(at(5.0, 1.7))) {
    const Eigen::Vector2d p = space_.centre(space_.cell(cell));
    const bool in_doorway = p.x() > 4.0 && p.x() < 4.1;
    EXPECT_TRUE(!in_doorway || std::abs(p.y() - 2.0) < 0.08);
  }
}

}  // namespace
}  // namespace lifeline::sources
