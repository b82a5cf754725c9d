#include "common/search/search_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/floor_picture.hpp"

namespace lifeline::search {
namespace {

using test::FloorPicture;
using testing::DoubleNear;

constexpr double kMapCellM = 0.05;
constexpr double kSquareM = kMapCellM * kFine;

Eigen::Vector2d at(int x, int y) {
  return {(x + 0.5) * kSquareM, (y + 0.5) * kSquareM};
}

SearchPlanner planner_of(const FloorPicture& picture) {
  SearchPlanner planner(kMapCellM);
  picture.put_into(planner);
  return planner;
}

// A corridor, open on the right; a room above with a door at x = 3..5, open on top.
const FloorPicture kCorridor({
    "#......#        ",  //
    "#......#        ",  //
    "###...##########",  //
    "#...............",  //
    "#...............",  //
    "#...............",  //
    "################",  //
});

TEST(SearchPlanner, EachOpenEndIsAPartAndWallsAreNone) {
  SearchPlanner planner = planner_of(kCorridor);
  const SearchPlan& plan = planner.make({});
  ASSERT_EQ(plan.parts.parts.size(), 2U);
  EXPECT_EQ(plan.parts.parts[0].cells.size(), 6U) << "the room's open side";
  EXPECT_EQ(plan.parts.parts[1].cells.size(), 3U) << "the corridor's open end";
  EXPECT_EQ(planner.cells().place(plan.parts.parts[1].cells[0]), (CellIndex{15, 1}));
  EXPECT_TRUE(plan.suggestions.empty());
}

TEST(SearchPlanner, OneHelmetIsSentToTheNearestPartByTheWayThatIsFree) {
  SearchPlanner planner = planner_of(kCorridor);
  const SearchPlan& plan = planner.make({{"alpha", at(11, 2)}});
  ASSERT_EQ(plan.suggestions.size(), 1U);
  const Reached& to = plan.suggestions[0].to;
  EXPECT_EQ(to.part, 1U);
  EXPECT_THAT(to.distance_m, DoubleNear(4 * kSquareM, 1e-9));
  EXPECT_EQ(to.way_m.front(), at(11, 2));
  EXPECT_EQ(to.way_m.back(), at(15, 2));
}

TEST(SearchPlanner, TwoHelmetsAreSentToTwoParts) {
  SearchPlanner planner = planner_of(kCorridor);
  const SearchPlan& plan = planner.make({{"alpha", at(12, 2)}, {"bravo", at(11, 2)}});
  ASSERT_EQ(plan.suggestions.size(), 2U);
  EXPECT_EQ(plan.suggestions[0].id, "alpha");
  EXPECT_EQ(plan.suggestions[0].to.part, 1U) << "who is nearer goes there";
  EXPECT_EQ(plan.suggestions[1].to.part, 0U);
}

TEST(SearchPlanner, AThirdHelmetHasNoneLeft) {
  SearchPlanner planner = planner_of(kCorridor);
  const SearchPlan& plan =
      planner.make({{"alpha", at(12, 2)}, {"bravo", at(11, 2)}, {"charlie", at(2, 2)}});
  EXPECT_EQ(plan.suggestions.size(), 2U);
}

TEST(SearchPlanner, NobodyIsSentThroughAWallOrFromOutsideOfTheMap) {
  SearchPlanner planner = planner_of(FloorPicture({"...#....", "...#....", "...#...."}));
  const SearchPlan& plan = planner.make({{"alpha", at(1, 1)}, {"far", at(500, 1)}});
  ASSERT_EQ(plan.suggestions.size(), 1U);
  for (const Eigen::Vector2d& p : plan.suggestions[0].to.way_m) EXPECT_LT(p.x(), 3 * kSquareM);
}

TEST(SearchPlanner, ASuggestionDoesNotFlipWhileTwoPartsAreAboutAsFar) {
  FloorPicture whole({std::string(40, '.'), std::string(40, '.'), std::string(40, '.'),
                      std::string(40, '.'), std::string(40, '.')});
  for (int x = 0; x < 40; ++x) {
    whole.set({x, -1}, '#');
    whole.set({x, 5}, '#');
  }
  SearchPlanner corridor = planner_of(whole);
  const auto target_x = [&](int x) {
    return corridor.make({{"alpha", at(x, 2)}}).suggestions.at(0).to.way_m.back().x();
  };
  const double right = target_x(22);
  EXPECT_GT(right, 7.0);
  EXPECT_EQ(target_x(19), right) << "a step back changes nothing";
  EXPECT_EQ(target_x(17), right);
  EXPECT_LT(target_x(6), 1.0) << "much nearer to the other end";
  EXPECT_LT(target_x(22), 1.0) << "and there it stays";
}

TEST(SearchPlanner, TheInsideOfATableIsNothingToSearch) {
  const std::vector<std::string> table({"##########", "#........#", "#..   ...#", "#..   ...#",
                                        "#..   ...#", "#..   ...#", "#........#", "##########"});
  EXPECT_TRUE(planner_of(FloorPicture(table)).make({}).parts.parts.empty()) << "12 squares";
  auto larger = table;
  larger[2] = "#..    ..#";
  EXPECT_FALSE(planner_of(FloorPicture(larger)).make({}).parts.parts.empty()) << "13 squares";
}

TEST(SearchPlanner, WhatIsSearchedMeanwhileIsNoPartAnyMore) {
  SearchPlanner planner = planner_of(kCorridor);
  ASSERT_EQ(planner.make({}).parts.parts.size(), 2U);
  FloorPicture end({"#", "#", "#"}, {16, 1});
  const auto& tiles = end.tiles();
  for (const auto& [tile, cells] : tiles) planner.put(tile, &cells);
  EXPECT_EQ(planner.make({}).parts.parts.size(), 1U);
  for (const auto& [tile, cells] : tiles) planner.put(tile, nullptr);
  EXPECT_EQ(planner.make({}).parts.parts.size(), 2U);
}

TEST(SearchPlanner, PiecesComeToTheSameAsAllAtOnce) {
  SearchPlanner whole = planner_of(kCorridor), pieces = planner_of(kCorridor);
  const std::vector<Seeker> seekers{{"alpha", at(12, 2)}, {"bravo", at(2, 2)}};
  const SearchPlan& expected = whole.make(seekers);
  pieces.begin(seekers);
  int steps = 0;
  FloorPicture elsewhere({"...", "...", "..."}, {200, 200});
  while (!pieces.work()) {
    if (++steps == 2) elsewhere.put_into(pieces);  // for the next plan
    ASSERT_LT(steps, 10);
  }
  EXPECT_EQ(steps, 3);
  ASSERT_EQ(pieces.plan().suggestions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(pieces.plan().suggestions[i].to.way_m, expected.suggestions[i].to.way_m);
  EXPECT_FALSE(pieces.work()) << "nothing is left to do";
}

TEST(FrontierOutline, GoesFromSquareToSquare) {
  SearchPlanner planner = planner_of(kCorridor);
  const auto& plan = planner.make({});
  const auto lines = outline_m(plan.parts.parts[0], planner.cells());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 6U);
  for (std::size_t i = 1; i < lines[0].size(); ++i)
    EXPECT_THAT((lines[0][i] - lines[0][i - 1]).norm(), DoubleNear(kSquareM, 1e-9));
}

}  // namespace
}  // namespace lifeline::search
