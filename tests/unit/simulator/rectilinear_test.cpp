#include "agents/sources/simulator/rectilinear.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace lifeline::sources {
namespace {

using ::testing::UnorderedElementsAre;

Box box(double x0, double y0, double x1, double y1) {
  return Box(Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1));
}

std::vector<std::string> texts(const std::vector<WallSegment>& walls) {
  std::vector<std::string> out;
  for (const auto& wall : walls) {
    out.push_back(fmt::format("{},{}>{},{}", wall.a.x(), wall.a.y(), wall.b.x(), wall.b.y()));
  }
  return out;
}

double area_of(const std::vector<WallSegment>& border) {
  FloorPlan plan;
  plan.walls = border;
  return plan.floor_area_m2();
}

TEST(BorderOf, ABoxHasFourSidesWithTheFloorToTheLeft) {
  const std::vector<Box> floors{box(0, 0, 2, 1)};

  EXPECT_THAT(texts(border_of(floors, {})),
              UnorderedElementsAre("0,0>2,0", "2,0>2,1", "2,1>0,1", "0,1>0,0"));
}

TEST(BorderOf, BoxesThatTouchBecomeOneRoomWithWholeSides) {
  const std::vector<Box> floors{box(0, 0, 2, 1), box(2, 0, 3, 1)};

  EXPECT_THAT(texts(border_of(floors, {})),
              UnorderedElementsAre("0,0>3,0", "3,0>3,1", "3,1>0,1", "0,1>0,0"));
}

TEST(BorderOf, OverlapsCountOnce) {
  const std::vector<Box> floors{box(0, 0, 4, 4), box(2, 2, 6, 6)};

  const auto border = border_of(floors, {});

  EXPECT_EQ(border.size(), 8U);
  EXPECT_DOUBLE_EQ(area_of(border), 28.0);
}

TEST(BorderOf, ASolidInTheMiddleIsAHoleRunRoundTheOtherWay) {
  const std::vector<Box> floors{box(0, 0, 4, 4)}, solids{box(1, 1, 2, 3)};

  const auto border = border_of(floors, solids);

  EXPECT_EQ(border.size(), 8U);
  EXPECT_THAT(texts(border), ::testing::IsSupersetOf({"1,1>1,3", "2,3>2,1", "1,3>2,3", "2,1>1,1"}));
  EXPECT_DOUBLE_EQ(area_of(border), 14.0);
}

TEST(BorderOf, ASolidAgainstTheWallChangesTheWall) {
  const std::vector<Box> floors{box(0, 0, 4, 4)}, solids{box(1, 0, 2, 1)};

  EXPECT_THAT(texts(border_of(floors, solids)),
              UnorderedElementsAre("0,0>1,0", "1,0>1,1", "1,1>2,1", "2,1>2,0", "2,0>4,0", "4,0>4,4",
                                   "4,4>0,4", "0,4>0,0"));
}

TEST(BorderOf, RoomsThatMeetAtACornerStaySeparateLoops) {
  const std::vector<Box> floors{box(0, 0, 1, 1), box(1, 1, 2, 2)};

  EXPECT_EQ(border_of(floors, {}).size(), 8U);
}

TEST(BorderOf, NothingHasNoBorder) {
  EXPECT_TRUE(border_of({}, {}).empty());
  const std::vector<Box> solids{box(0, 0, 1, 1)};
  EXPECT_TRUE(border_of({}, solids).empty());
}

TEST(BorderOf, AFloorThatIsAllSolidHasNoBorder) {
  const std::vector<Box> floors{box(0, 0, 1, 1)}, solids{box(-1, -1, 2, 2)};
  EXPECT_TRUE(border_of(floors, solids).empty());
}

}  // namespace
}  // namespace lifeline::sources
