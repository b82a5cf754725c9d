#include "agents/sources/simulator/tour.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/office.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using Ways = std::vector<std::vector<std::size_t>>;

FreeSpace office_floor() {
  return FreeSpace::make(generate_office({}).value()).value();
}

/// The share of walkable cells within sight of a way, at most `sight_m` off.
double share_seen(const FreeSpace& space, const Ways& ways, double sight_m) {
  std::vector<bool> seen(space.size());
  const int reach = static_cast<int>(sight_m / FreeSpace::kCellM);
  for (const auto& way : ways) {
    for (std::size_t k = 0; k < way.size(); k += 8) {
      const CellIndex from = space.cell(way[k]);
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const CellIndex cell{from.x + dx, from.y + dy};
          if (!space.is_walkable(cell) || dx * dx + dy * dy > reach * reach) continue;
          if (!seen[space.index(cell)]) seen[space.index(cell)] = space.can_see(from, cell);
        }
      }
    }
  }
  std::size_t walkable = 0, count = 0;
  for (std::size_t i = 0; i < space.size(); ++i) {
    walkable += space.is_walkable(space.cell(i));
    count += seen[i];
  }
  return static_cast<double>(count) / static_cast<double>(walkable);
}

TEST(Tour, OneRoundBringsAWalkerWithinSightOfTheWholeFloor) {
  const FreeSpace space = office_floor();
  Tour tour(space, {.seed = 1, .walker = 0, .walkers = 1});
  const Ways ways = tour.next_round();
  // 2.6 m from a place, and a place counts as visited from 0.6 m.
  EXPECT_GT(share_seen(space, ways, 3.2), 0.98);
}

TEST(Tour, WaysFollowUponEachOtherFromTheStart) {
  const FreeSpace space = office_floor();
  Tour tour(space, {.seed = 1, .walker = 2, .walkers = 3});
  std::size_t here = tour.start();
  for (int round = 0; round < 3; ++round) {
    for (const auto& way : tour.next_round()) {
      EXPECT_EQ(way.front(), here);
      here = way.back();
    }
    EXPECT_EQ(tour.start(), here);
  }
}

TEST(Tour, IsTheSameForTheSameNumbers) {
  const FreeSpace space = office_floor();
  Tour a(space, {.seed = 4, .walker = 1, .walkers = 3}),
      b(space, {.seed = 4, .walker = 1, .walkers = 3});
  EXPECT_EQ(a.next_round(), b.next_round());
  EXPECT_EQ(a.next_round(), b.next_round());
}

TEST(Tour, WalkersBeginFarFromEachOtherAndGoOtherWays) {
  const FreeSpace space = office_floor();
  std::vector<Eigen::Vector2d> starts;
  std::set<Ways> rounds;
  for (int walker = 0; walker < 4; ++walker) {
    Tour tour(space, {.seed = 1, .walker = walker, .walkers = 1});
    starts.push_back(space.centre(space.cell(tour.start())));
    rounds.insert(tour.next_round());
  }
  EXPECT_EQ(rounds.size(), 4U);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    for (std::size_t j = i + 1; j < starts.size(); ++j) {
      EXPECT_GT((starts[i] - starts[j]).norm(), 4.0);
    }
  }
}

TEST(Tour, AnotherSeedMakesOtherWalks) {
  const FreeSpace space = office_floor();
  Tour a(space, {.seed = 1, .walker = 0, .walkers = 1}),
      b(space, {.seed = 2, .walker = 0, .walkers = 1});
  EXPECT_NE(a.next_round(), b.next_round());
}

TEST(Tour, WalkersAgreeOnTheirStartsHoweverManyLook) {
  const FreeSpace space = office_floor();
  Tour alone(space, {.seed = 3, .walker = 1, .walkers = 1});
  Tour shared(space, {.seed = 3, .walker = 1, .walkers = 3});
  EXPECT_EQ(alone.start(), shared.start());
}

TEST(Tour, SeveralWalkersHaveShorterRoundsThatTogetherShowEverything) {
  const FreeSpace space = office_floor();
  const auto cells = [](const Ways& ways) {
    std::size_t count = 0;
    for (const auto& way : ways) count += way.size();
    return count;
  };
  Tour alone(space, {.seed = 1, .walker = 0, .walkers = 1});
  const std::size_t whole = cells(alone.next_round());
  Ways together;
  for (int walker = 0; walker < 3; ++walker) {
    Tour tour(space, {.seed = 1, .walker = walker, .walkers = 3});
    const Ways own = tour.next_round();
    EXPECT_LT(cells(own), whole);
    EXPECT_LT(share_seen(space, own, 3.2), 0.95);
    together.insert(together.end(), own.begin(), own.end());
  }
  EXPECT_GT(share_seen(space, together, 3.2), 0.98);
}

TEST(Tour, AfterItsOwnPartAWalkerSeesTheRest) {
  const FreeSpace space = office_floor();
  Tour tour(space, {.seed = 1, .walker = 0, .walkers = 3});
  Ways ways = tour.next_round();
  const Ways rest = tour.next_round();
  ways.insert(ways.end(), rest.begin(), rest.end());
  EXPECT_GT(share_seen(space, ways, 3.2), 0.98);
}

TEST(Tour, ARoomThatIsSeenAtAGlanceNeedsNoSteps) {
  const FreeSpace space = FreeSpace::make(support::room(1.9, 1.9)).value();
  Tour tour(space, {});
  EXPECT_LE(tour.next_round().size(), 1U);
}

}  // namespace
}  // namespace lifeline::sources
