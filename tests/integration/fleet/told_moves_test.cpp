// Maps grow, merges are measured better and better: what everybody shares moves, and it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "coordinator/layer_watch.hpp"
#include "tests/integration/fleet/drill.hpp"

namespace lifeline::test {
namespace {

const std::vector<std::string> kIds{"alpha", "bravo", "charlie"};

class ToldMovesTest : public testing::Test {
 protected:
  ToldMovesTest() : drill_(1, kIds) {}

  /// The farthest that a corner of a helmet's known map lies from where the plan has it now.
  [[nodiscard]] double farthest_from_plan_m() {
    const Coordinator& coordinator = drill_.fleet().coordinator();
    double farthest_m = 0.0;
    for (const auto& member : coordinator.directive().members) {
      const auto layer = sharing::to_layer_key(member.layer).value();
      LayerWatch walls;
      for (const auto& [tile, held] : *coordinator.store().find(layer))
        walls.note(tile, held.cells);
      const Pose2 told = sharing::to_pose(member.T_common_map), planned = planned_place(layer);
      const auto extent = walls.extent(0.05);
      for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                                Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
        const Eigen::Vector2d p_map = extent.corner(corner);
        farthest_m = std::max(farthest_m, (told * p_map - planned * p_map).norm());
      }
    }
    return farthest_m;
  }
  [[nodiscard]] Pose2 planned_place(const LayerKey& layer) {
    for (const auto& group : drill_.fleet().coordinator().plan().groups) {
      for (const auto& member : group) {
        if (member.layer == layer) return member.T_common_map;
      }
    }
    ADD_FAILURE() << to_string(layer) << " is told to be a member and is none";
    return {};
  }

  Drill drill_;
};

TEST_F(ToldMovesTest, NoCornerOfAMapIsEverFarFromWhereThePlanHasIt) {
  for (double until_s = 26; until_s <= 50; until_s += 3) {
    drill_.walk_to(until_s);
    EXPECT_LT(farthest_from_plan_m(), 0.05) << "at " << until_s << " s";
  }
  EXPECT_EQ(drill_.fleet().group(), kIds);
}

TEST_F(ToldMovesTest, EveryNewDirectiveIsExplainedByTheMatchThatLedToIt) {
  for (double until_s = 26; until_s <= 50; until_s += 4) drill_.walk_to(until_s);
  ASSERT_GT(drill_.fleet().directives().size(), 1U);
  std::string reasons;
  for (const auto& evidence : drill_.fleet().evidence()) reasons += evidence.reason + "\n";
  for (const auto& directive : drill_.fleet().directives())
    EXPECT_THAT(reasons,
                testing::HasSubstr("[directive " + std::to_string(directive.epoch) + ": "));
}

}  // namespace
}  // namespace lifeline::test
