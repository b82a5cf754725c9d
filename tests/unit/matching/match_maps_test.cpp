#include "coordinator/matching/match_maps.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "common/base/angles.hpp"
#include "tests/support/drawn_building.hpp"

namespace lifeline::matching {
namespace {

using test::draw_map;
using test::uneven_building;

MapFeatures features(const OccupancyGrid& grid) {
  return build_features(grid).value();
}

void expect_close(const Pose2& found, const Pose2& truth, double distance_m, double angle_rad) {
  EXPECT_LT((found.translation() - truth.translation()).norm(), distance_m);
  EXPECT_LT(std::abs(normalise_angle(found.yaw_rad - truth.yaw_rad)), angle_rad);
}

class MatchMapsTest : public testing::Test {
 protected:
  const Pose2 T_world_a_{6.0, 1.0, 0.2}, T_world_b_{7.5, 2.5, -1.9};
  const Pose2 T_a_b_ = T_world_a_.inverse() * T_world_b_;
  const MapFeatures a_ = features(draw_map(uneven_building(), T_world_a_, 24.0));
  const MapFeatures b_ = features(draw_map(uneven_building(), T_world_b_, 24.0));
};

TEST_F(MatchMapsTest, OneBuildingSeenTwiceIsAcceptedWhereItIs) {
  const MatchResult result = match_maps(a_, b_, {});
  ASSERT_TRUE(result.accepted()) << result.reason;
  expect_close(result.candidates.front().T_a_b, T_a_b_, 0.03, 0.3 * kDegree);
  EXPECT_GT(result.candidates.front().acceptance_index, 0.95);
  EXPECT_GT(result.candidates.front().s_overlapping, 0.0);
  EXPECT_GT(result.margin, 0.3);
}

TEST_F(MatchMapsTest, ThePapersSpectraFindTheSamePlace) {
  MatchConfig paper;
  paper.method = Method::spectra;
  const MatchResult result = match_maps(a_, b_, paper);
  ASSERT_FALSE(result.candidates.empty());
  expect_close(result.candidates.front().T_a_b, T_a_b_, 0.3, 2.0 * kDegree);
}

TEST_F(MatchMapsTest, AnyRotationAndShiftIsRecovered) {
  std::mt19937 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int i = 0; i < 6; ++i) {
    const Pose2 T_world_c{uniform(4, 9), uniform(-1, 4),
                          uniform(-std::numbers::pi, std::numbers::pi)};
    const MatchResult result =
        match_maps(a_, features(draw_map(uneven_building(), T_world_c, 24.0)), {});
    ASSERT_TRUE(result.accepted()) << result.reason;
    expect_close(result.candidates.front().T_a_b, T_world_a_.inverse() * T_world_c, 0.03,
                 0.3 * kDegree);
  }
}

TEST_F(MatchMapsTest, SwappedMapsGiveTheInverse) {
  const MatchResult forth = match_maps(a_, b_, {}), back = match_maps(b_, a_, {});
  ASSERT_TRUE(forth.accepted() && back.accepted());
  expect_close(back.candidates.front().T_a_b, forth.candidates.front().T_a_b.inverse(), 0.01,
               0.1 * kDegree);
}

TEST_F(MatchMapsTest, TheSameInputsGiveTheSameBits) {
  const MatchResult first = match_maps(a_, b_, {}), second = match_maps(a_, b_, {});
  EXPECT_EQ(first.candidates.front().T_a_b.x_m, second.candidates.front().T_a_b.x_m);
  EXPECT_EQ(first.candidates.front().score, second.candidates.front().score);
}

TEST_F(MatchMapsTest, ASymmetricFloorWaitsAndNamesBothPlaces) {
  test::DrawnBuilding hall;
  hall.add_room({-8.0, -3.0}, {8.0, 3.0});
  const auto left = features(draw_map(hall, {0.5, 0.2, 0.4}, 22.0)),
             right = features(draw_map(hall, {-0.5, 0.3, 1.0}, 22.0));
  const MatchResult result = match_maps(left, right, {});
  EXPECT_EQ(result.verdict, Verdict::wait) << result.reason;
  ASSERT_GE(result.candidates.size(), 2U);
  EXPECT_NE(result.reason.find("two places fit"), std::string::npos) << result.reason;
  const double turn =
      normalise_angle(result.candidates[0].T_a_b.yaw_rad - result.candidates[1].T_a_b.yaw_rad);
  EXPECT_NEAR(std::abs(turn), std::numbers::pi, 2.0 * kDegree);
}

TEST_F(MatchMapsTest, AnotherBuildingIsNotAccepted) {
  test::DrawnBuilding other;
  other.add_room({0.0, 0.0}, {5.0, 9.0});
  other.add_room({5.0, 0.0}, {8.2, 2.6});
  other.add_room({5.0, 2.6}, {12.0, 9.0});
  other.walls.push_back({{6.0, 5.0}, {8.0, 6.5}});
  EXPECT_FALSE(match_maps(a_, features(draw_map(other, {5.0, 4.0, 0.9}, 24.0)), {}).accepted());
}

TEST_F(MatchMapsTest, TheMirrorImageIsNotAccepted) {
  test::DrawnBuilding mirrored;
  for (const auto& wall : uneven_building().walls) {
    mirrored.walls.push_back({{-wall.from.x(), wall.from.y()}, {-wall.to.x(), wall.to.y()}});
  }
  for (const auto& [low, high] : uneven_building().rooms) {
    mirrored.rooms.push_back({{-high.x(), low.y()}, {-low.x(), high.y()}});
  }
  const MatchResult result =
      match_maps(a_, features(draw_map(mirrored, {-6.0, 1.0, 0.0}, 24.0)), {});
  EXPECT_FALSE(result.accepted()) << result.reason;
}

TEST_F(MatchMapsTest, AnAcceptedMatchBeatsTheMirrorImageTwice) {
  const MatchResult result = match_maps(a_, b_, {});
  ASSERT_TRUE(result.accepted()) << result.reason;
  ASSERT_TRUE(result.control_score.has_value());
  EXPECT_GT(result.candidates.front().score, 2.0 * *result.control_score);
}

TEST_F(MatchMapsTest, ASquareHallNamesPlacesAQuarterTurnApart) {
  test::DrawnBuilding hall;
  hall.add_room({-4.0, -4.0}, {4.0, 4.0});
  const MatchResult result = match_maps(features(draw_map(hall, {0.5, 0.2, 0.4}, 14.0)),
                                        features(draw_map(hall, {-0.5, 0.3, 1.0}, 14.0)), {});
  EXPECT_EQ(result.verdict, Verdict::wait) << result.reason;
  EXPECT_NE(result.reason.find("two places fit"), std::string::npos) << result.reason;
  ASSERT_EQ(result.candidates.size(), 4U);
  const double turn = normalise_angle(
      4 * (result.candidates[0].T_a_b.yaw_rad - result.candidates[1].T_a_b.yaw_rad));
  EXPECT_NEAR(turn, 0.0, 8.0 * kDegree);
}

TEST_F(MatchMapsTest, ASymmetricFloorIsDecidedOnceAnUnevenPartIsSeen) {
  test::DrawnBuilding hall;
  hall.add_room({-8.0, -3.0}, {8.0, 3.0});
  for (const auto& [low, high] : uneven_building().rooms) {
    hall.add_room(low + Eigen::Vector2d(8.0, 0.0), high + Eigen::Vector2d(8.0, 0.0));
  }
  const Pose2 T_world_a{4.0, 0.2, 0.4}, T_world_b{5.0, 0.3, 1.0};
  const MatchResult result = match_maps(features(draw_map(hall, T_world_a, 44.0)),
                                        features(draw_map(hall, T_world_b, 44.0)), {});
  ASSERT_TRUE(result.accepted()) << result.reason;
  expect_close(result.candidates.front().T_a_b, T_world_a.inverse() * T_world_b, 0.05,
               0.3 * kDegree);
}

TEST_F(MatchMapsTest, ASquareFloorIsDecidedOnceAnUnevenPartIsSeen) {
  test::DrawnBuilding hall;
  hall.add_room({-4.0, -4.0}, {4.0, 4.0});
  for (const auto& [low, high] : uneven_building().rooms) {
    hall.add_room(low + Eigen::Vector2d(4.0, 0.0), high + Eigen::Vector2d(4.0, 0.0));
  }
  const Pose2 T_world_a{4.0, 0.2, 0.4}, T_world_b{5.0, 0.3, 1.0};
  const MatchResult result = match_maps(features(draw_map(hall, T_world_a, 44.0)),
                                        features(draw_map(hall, T_world_b, 44.0)), {});
  ASSERT_TRUE(result.accepted()) << result.reason;
  expect_close(result.candidates.front().T_a_b, T_world_a.inverse() * T_world_b, 0.05,
               0.3 * kDegree);
}

TEST_F(MatchMapsTest, AMapOfOneCellHasNoWalls) {
  OccupancyGrid cell;
  cell.columns = cell.rows = 1;
  cell.cells.assign(1, Occupancy::occupied);
  const MatchResult result = match_maps(features(cell), b_, {});
  EXPECT_EQ(result.verdict, Verdict::wait);
  EXPECT_NE(result.reason.find("no walls"), std::string::npos);
}

TEST_F(MatchMapsTest, AnOriginThatIsNoNumberIsRefused) {
  OccupancyGrid grid = draw_map(uneven_building(), T_world_a_, 24.0);
  grid.origin_m.x() = std::nan("");
  const auto built = build_features(grid);
  ASSERT_FALSE(built);
  EXPECT_NE(built.error().text.find("origin"), std::string::npos);
}

TEST_F(MatchMapsTest, MapsWithoutWallsWaitAndSaySo) {
  OccupancyGrid unknown;
  unknown.columns = unknown.rows = 50;
  unknown.cells.assign(2500, Occupancy::unknown);
  for (const OccupancyGrid& grid : {OccupancyGrid{}, unknown}) {
    const MatchResult result = match_maps(a_, features(grid), {});
    EXPECT_EQ(result.verdict, Verdict::wait);
    EXPECT_NE(result.reason.find("no walls"), std::string::npos);
    EXPECT_TRUE(result.candidates.empty());
  }
}

TEST_F(MatchMapsTest, MapsOfDifferentCellSizeAreRejected) {
  OccupancyGrid coarse = draw_map(uneven_building(), T_world_b_, 24.0);
  coarse.cell_size_m = 0.1;
  EXPECT_EQ(match_maps(a_, features(coarse), {}).verdict, Verdict::rejected);
}

TEST_F(MatchMapsTest, AMapBeyondTheLimitsIsRefusedBeforeAnyWork) {
  OccupancyGrid huge;
  huge.columns = kMaxCellsPerSide + 1;
  huge.rows = 1;
  huge.cells.assign(static_cast<std::size_t>(huge.columns), Occupancy::free);
  EXPECT_FALSE(build_features(huge));
}

}  // namespace
}  // namespace lifeline::matching
