#include "agents/sources/simulator/doors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "agents/sources/simulator/houseexpo.hpp"
#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/walk.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

const Doorway kDoorway{{0.0, 0.0}, {0.9, 0.0}};
const Eigen::Vector2d kBeside(0.45, 2.0);

/// How often a single door changed within a minute.
int changes(Doors::When when, const Eigen::Vector2d& p_walker) {
  Doors doors({kDoorway}, when, 1);
  int count = 0;
  bool closed = false;
  for (int tick = 0; tick < 600; ++tick) {
    doors.advance(0.1 * tick, p_walker);
    if (tick > 0 && closed != !doors.closed().empty()) ++count;
    closed = !doors.closed().empty();
  }
  return count;
}

TEST(FindDoorways, FindsTheOneBetweenTwoRooms) {
  const FloorPlan plan = support::two_rooms(0.9);
  const auto doorways = find_doorways(plan, FreeSpace::make(plan).value());

  ASSERT_EQ(doorways.size(), 1U);
  const Eigen::Vector2d middle = 0.5 * (doorways[0].a + doorways[0].b);
  EXPECT_NEAR(middle.x(), 4.05, 0.1);
  EXPECT_NEAR(middle.y(), 2.0, 0.03);
  EXPECT_NEAR((doorways[0].a - doorways[0].b).norm(), 0.9, 1e-6);
}

TEST(FindDoorways, FindsNoneInARoomNorInAWideOpening) {
  const FloorPlan room = support::room(4.0, 3.0), wide = support::two_rooms(2.0);
  EXPECT_TRUE(find_doorways(room, FreeSpace::make(room).value()).empty());
  EXPECT_TRUE(find_doorways(wide, FreeSpace::make(wide).value()).empty());
}

TEST(FindDoorways, FindsMostOfAnOfficesOwn) {
  const FloorPlan plan = generate_office({}).value();
  const auto found = find_doorways(plan, FreeSpace::make(plan).value());
  int known = 0;
  for (const Doorway& doorway : plan.doorways) {
    const Eigen::Vector2d middle = 0.5 * (doorway.a + doorway.b);
    known += std::any_of(found.begin(), found.end(), [&](const Doorway& other) {
      return (0.5 * (other.a + other.b) - middle).norm() < 0.3;
    });
  }
  EXPECT_GE(known, 0.7 * static_cast<double>(plan.doorways.size()));
}

TEST(FindDoorways, HouseExpoPlansHaveSome) {
  const auto files = support::houseexpo_files();
  if (files.empty()) GTEST_SKIP() << "the HouseExpo plans are not here";
  int with_doors = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    const FloorPlan plan = read_houseexpo(files[i * files.size() / 10]).value();
    with_doors += find_doorways(plan, FreeSpace::make(plan).value()).empty() ? 0 : 1;
  }
  EXPECT_GE(with_doors, 8);
}

TEST(Doors, NeverMeansThatEveryDoorwayStandsOpen) {
  EXPECT_EQ(changes(Doors::When::never, kBeside), 0);
  EXPECT_EQ(Doors({kDoorway}, Doors::When::never, 1).count(), 0U);
}

TEST(Doors, BesideTheWalkerADoorChangesEveryFewSeconds) {
  const int count = changes(Doors::When::beside, kBeside);
  EXPECT_GE(count, 60 / 5 - 1);
  EXPECT_LE(count, 60 / 2 + 1);
}

TEST(Doors, FarFromTheWalkerADoorStaysAsItIsUnlessItHasATimetable) {
  const Eigen::Vector2d far(0.45, 20.0);
  EXPECT_EQ(changes(Doors::When::beside, far), 0);
  EXPECT_GE(changes(Doors::When::timetable, far), 60 / 25 - 1);
}

TEST(Doors, AClosedDoorIsAWallFromJambToJamb) {
  Doors doors({kDoorway}, Doors::When::beside, 1);
  for (double t = 0.0; doors.closed().empty() && t < 10.0; t += 0.1) doors.advance(t, kBeside);
  ASSERT_EQ(doors.closed().size(), 1U);
  EXPECT_EQ(doors.closed()[0].a, kDoorway.a);
  EXPECT_EQ(doors.closed()[0].b, kDoorway.b);
}

TEST(Doors, StandOpenForWhoeverIsInTheirWay) {
  EXPECT_EQ(changes(Doors::When::beside, {0.45, 0.4}), 0);
  EXPECT_EQ(changes(Doors::When::timetable, {0.45, -0.4}), 0);
}

TEST(Doors, NoWalkerEverGoesThroughAClosedOne) {
  const FloorPlan plan = generate_office({}).value();
  const FreeSpace space = FreeSpace::make(plan).value();
  for (const auto when : {Doors::When::timetable, Doors::When::beside}) {
    Walk walk(space, {});
    Doors doors(plan.doorways, when, 5);
    std::size_t seen_closed = 0;
    for (int tick = 0; tick < 1800; ++tick) {
      const Eigen::Vector2d p = walk.pose_at(0.1 * tick).translation();
      doors.advance(0.1 * tick, p);
      seen_closed += doors.closed().size();
      for (const WallSegment& leaf : doors.closed()) EXPECT_GT(distance_to(leaf, p), 0.5);
    }
    EXPECT_GT(seen_closed, 1800U);
  }
}

}  // namespace
}  // namespace lifeline::sources
