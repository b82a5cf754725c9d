#include "agents/sources/simulator/finds.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using sensing::SightedKind;
using ::testing::HasSubstr;

Result<FindsWanted> wanted(const std::string& text) {
  return read_finds(parse_source_spec("sim:office?victims=" + text).value(), "victims");
}

TEST(ReadFinds, TakesANumberOrPlaces) {
  EXPECT_EQ(wanted("3")->count, 3);
  EXPECT_EQ(wanted("32")->count, FindsWanted::kMost);
  const auto places = wanted("1.5,-2;8,0.25");
  ASSERT_TRUE(places);
  ASSERT_EQ(places->places.size(), 2U);
  EXPECT_EQ(places->places[0], Eigen::Vector2d(1.5, -2.0));
  EXPECT_EQ(places->places[1], Eigen::Vector2d(8.0, 0.25));
  EXPECT_EQ(read_finds(parse_source_spec("sim:office").value(), "victims")->count, 0);
}

TEST(ReadFinds, RefusesAllElseInOneLine) {
  std::string many = "1,1";
  for (int i = 0; i < FindsWanted::kMost; ++i) many += ";1,1";
  for (const std::string& text :
       {std::string("1,2;"), std::string("1,"), std::string(",1"), std::string("1,2,3"),
        std::string("1,nan"), std::string("1;2,3"), many}) {
    const auto read = wanted(text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::wrong_use);
    EXPECT_THAT(read.error().text, HasSubstr("is neither a number nor up to 32 places"));
  }
  EXPECT_THAT(wanted("33").error().text, HasSubstr("not an integer from 0 to 32"));
  EXPECT_THAT(wanted("-1").error().text, HasSubstr("not an integer"));
}

class PlaceFinds : public ::testing::Test {
 protected:
  const FreeSpace space_ = FreeSpace::make(support::room(20.0, 20.0)).value();
};

TEST_F(PlaceFinds, PutsThemOnWalkableFloorApartFromEachOtherTheSameForEachSeed) {
  const auto finds = place_finds(space_, {8, {}}, {4, {}}, 7).value();
  ASSERT_EQ(finds.size(), 12U);
  for (std::size_t i = 0; i < finds.size(); ++i) {
    EXPECT_EQ(finds[i].kind, i < 8 ? SightedKind::victim : SightedKind::uwb_tag);
    EXPECT_TRUE(space_.is_walkable(space_.cell_at(finds[i].p_world)));
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((finds[i].p_world - finds[k].p_world).norm(), 2.5);
    }
  }
  const auto again = place_finds(space_, {8, {}}, {4, {}}, 7).value();
  const auto other = place_finds(space_, {8, {}}, {4, {}}, 8).value();
  EXPECT_EQ(again[5].p_world, finds[5].p_world);
  EXPECT_NE(other[5].p_world, finds[5].p_world);
}

TEST_F(PlaceFinds, EndsWhereThereIsNoRoomToKeepThemApart) {
  const auto small = FreeSpace::make(support::room(2.0, 2.0)).value();
  EXPECT_EQ(place_finds(small, {32, {}}, {}, 1)->size(), 32U);
}

TEST_F(PlaceFinds, TakesPlacesAsGivenAndRefusesThoseThatAreNoFloor) {
  EXPECT_EQ(place_finds(space_, {0, {{3.0, 4.0}}}, {}, 1)->at(0).p_world,
            Eigen::Vector2d(3.0, 4.0));
  const auto outside = place_finds(space_, {}, {0, {{30.0, 4.0}}}, 1);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().text, "sim: a tag at 30.00,4.00 would not lie on the floor");
}

/// What is seen of a victim at `p` in two rooms beside each other, in `looks` looks.
std::vector<sensing::Sighting> looks(const Eigen::Vector2d& p, const Pose2& head, int looks,
                                     std::span<const WallSegment> more_walls = {},
                                     SightedKind kind = SightedKind::victim) {
  const RayScene scene(support::two_rooms(0.9).walls);
  SimulatedDetector detector({{kind, p}}, 3);
  std::vector<sensing::Sighting> all;
  for (int i = 0; i < looks; ++i) {
    for (const auto& each : detector.look(scene, head, more_walls)) all.push_back(each);
  }
  return all;
}

TEST(SimulatedDetector, SeesWhatLiesInSightWhereItIs) {
  const Pose2 head{1.0, 1.0, 0.5 * std::numbers::pi};
  const auto seen = looks({1.0, 3.0}, head, 2000);
  EXPECT_NEAR(static_cast<double>(seen.size()) / 2000.0, 0.8, 0.03);
  Eigen::Vector2d mean{0.0, 0.0};
  double square_m2 = 0.0;
  for (const auto& each : seen) {
    EXPECT_EQ(each.kind, SightedKind::victim);
    EXPECT_NEAR(each.confidence, 0.8, 1e-9);  // two of eight metres
    mean += each.p_head_m / static_cast<double>(seen.size());
    square_m2 += std::pow(each.p_head_m.x() - 2.0, 2) / static_cast<double>(seen.size());
  }
  EXPECT_NEAR((mean - Eigen::Vector2d(2.0, 0.0)).norm(), 0.0, 0.01);
  EXPECT_NEAR(std::sqrt(square_m2), 0.07, 0.01);
  EXPECT_NEAR(seen[0].sigma_m, 0.07, 1e-9);
}

TEST(SimulatedDetector, SeesNothingThroughWallsAndClosedDoors) {
  const Pose2 head{1.0, 2.0, 0.0};
  EXPECT_TRUE(looks({6.0, 0.5}, head, 50).empty());   // behind the wall between the rooms
  EXPECT_FALSE(looks({6.0, 2.0}, head, 50).empty());  // through the doorway
  const WallSegment door{{4.05, 1.0}, {4.05, 3.0}};
  EXPECT_TRUE(looks({6.0, 2.0}, head, 50, std::span(&door, 1)).empty());
}

TEST(SimulatedDetector, SeesNothingBeyondItsRange) {
  const RayScene scene(support::room(30.0, 10.0).walls);
  for (const SightedKind kind : {SightedKind::victim, SightedKind::uwb_tag}) {
    const double range_m = SimulatedDetector::model_of(kind).range_m;
    for (const double extra_m : {-0.01, 0.01}) {
      SimulatedDetector detector({{kind, {1.0 + range_m + extra_m, 5.0}}}, 1);
      std::size_t seen = 0;
      for (int i = 0; i < 50; ++i) seen += detector.look(scene, {1.0, 5.0, 0.3}, {}).size();
      EXPECT_EQ(seen > 0, extra_m < 0.0);
    }
  }
}

TEST(SimulatedDetector, TheNoiseOfOneFindDoesNotDependOnTheOthers) {
  const RayScene scene(support::room(30.0, 10.0).walls);
  const Find far{SightedKind::victim, {29.0, 5.0}}, near{SightedKind::victim, {3.0, 5.0}};
  const Find hidden{SightedKind::victim, {25.0, 5.0}};
  SimulatedDetector one({far, near}, 5), two({hidden, near}, 5);
  for (int i = 0; i < 20; ++i) {
    const auto a = one.look(scene, {1.0, 5.0, 0.0}, {}), b = two.look(scene, {1.0, 5.0, 0.0}, {});
    ASSERT_EQ(a.size(), b.size());
    if (!a.empty()) {
      EXPECT_EQ(a[0].p_head_m, b[0].p_head_m);
    }
  }
}

TEST(SimulatedSource, CarriesSightingsAndIsOtherwiseTheSameWithAndWithoutFinds) {
  const std::string walk = "sim:office?beams=90&duration=20";
  const auto with = open_simulated_source(parse_source_spec(walk + "&victims=8").value());
  const auto without = open_simulated_source(parse_source_spec(walk).value());
  std::size_t sightings = 0;
  for (int i = 0; i < 200; ++i) {
    const auto a = (*with)->next().value().value(), b = (*without)->next().value().value();
    ASSERT_EQ(a.ranges_m, b.ranges_m);
    ASSERT_EQ(a.attitude->yaw_rad, b.attitude->yaw_rad);
    EXPECT_TRUE(b.sightings.empty());
    sightings += a.sightings.size();
  }
  EXPECT_GT(sightings, 20U);
}

}  // namespace
}  // namespace lifeline::sources
