#include "coordinator/merging/directive_writer.hpp"

#include <gtest/gtest.h>

#include "common/sharing/accept.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using test::layer;

MergePlan plan(const Pose2& T_alpha_bravo) {
  MergeGraph graph;
  graph.set_edge({layer("alpha"), layer("bravo")},
                 {T_alpha_bravo, Eigen::Matrix3d::Identity(), 0.5});
  return graph.plan();
}

class DirectiveWriterTest : public testing::Test {
 protected:
  DirectiveWriter writer_{{.own_weight = 0.95}, test::kMission};
};

TEST_F(DirectiveWriterTest, WritesAWholeAndSoundAnswer) {
  ASSERT_TRUE(writer_.update(plan({1.25, -2.5, 0.75})));
  const auto& directive = writer_.directive();
  EXPECT_EQ(directive.epoch, 1U);
  EXPECT_EQ(directive.own_weight_permille, 950);
  ASSERT_EQ(directive.members.size(), 2U);
  EXPECT_TRUE(sharing::check_directive(directive));
  const Pose2 T_common_bravo = sharing::to_pose(directive.members[1].T_common_map);
  EXPECT_NEAR(T_common_bravo.x_m, 1.25, 1e-6);
  EXPECT_NEAR(T_common_bravo.yaw_rad, 0.75, 1e-8);
}

TEST_F(DirectiveWriterTest, AMoveTooSmallToMatterMakesNoNewEpoch) {
  ASSERT_TRUE(writer_.update(plan({1.0, 0.0, 0.0})));
  EXPECT_FALSE(writer_.update(plan({1.02, 0.0, 0.0})));
  EXPECT_EQ(writer_.directive().epoch, 1U);
  EXPECT_TRUE(writer_.update(plan({1.04, 0.0, 0.0})));
  EXPECT_EQ(writer_.directive().epoch, 2U);
}

TEST_F(DirectiveWriterTest, MovesThatAddUpAreToldOnceTheSumMatters) {
  ASSERT_TRUE(writer_.update(plan({1.0, 0.0, 0.0})));
  EXPECT_FALSE(writer_.update(plan({1.02, 0.0, 0.0})));
  EXPECT_TRUE(writer_.update(plan({1.04, 0.0, 0.0}))) << "measured from what the fleet was told";
}

TEST_F(DirectiveWriterTest, ASmallTurnIsTheMoveOfTheFarthestCorner) {
  // The far corner of bravo's map is 50 m off: 0.002 rad are 0.1 m there and nothing at the origin.
  const Extents extents{{layer("bravo"), {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, 40)}}};
  ASSERT_TRUE(writer_.update(plan({1.0, 0.0, 0.0}), extents));
  EXPECT_FALSE(writer_.update(plan({1.0, 0.0, 0.0005}), extents));
  const auto change = writer_.update(plan({1.0, 0.0, 0.002}), extents);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->moved.front().layer, layer("bravo"));
  EXPECT_NEAR(change->moved.front().moved_m, 0.1, 1e-6);
  EXPECT_EQ(change->describe(), "bravo moves by 0.10 m");
}

TEST_F(DirectiveWriterTest, WhoJoinsAndLeavesIsNamed) {
  auto change = writer_.update(plan({}));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->describe(), "joined: alpha, bravo");
  change = writer_.update(MergePlan{});
  ASSERT_TRUE(change);
  EXPECT_EQ(change->describe(), "left: alpha, bravo");
  EXPECT_EQ(change->epoch, Epoch{2});
}

TEST_F(DirectiveWriterTest, AnotherLeadIsNamedAsAnotherCommonFrame) {
  ASSERT_TRUE(writer_.update(plan({1.0, 0.0, 0.0})));
  MergeGraph graph;
  graph.set_edge({layer("alpha"), layer("bravo")},
                 {{1.0, 0.0, 0.0}, Eigen::Matrix3d::Identity(), 0.5});
  const auto change = writer_.update(graph.plan({layer("bravo")}));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->describe(), "another common frame: alpha, bravo");
}

TEST_F(DirectiveWriterTest, AnEmptyPlanWithdrawsTheMembers) {
  ASSERT_TRUE(writer_.update(plan({})));
  ASSERT_TRUE(writer_.update(MergePlan{}));
  EXPECT_EQ(writer_.directive().epoch, 2U);
  EXPECT_TRUE(writer_.directive().members.empty());
}

TEST_F(DirectiveWriterTest, ANewCoordinatorOutranksWhatHelmetsStillFollow) {
  EXPECT_FALSE(writer_.outrank(Epoch{41})) << "nothing to say yet";
  ASSERT_TRUE(writer_.update(plan({})));
  EXPECT_EQ(writer_.directive().epoch, 42U);
  EXPECT_FALSE(writer_.outrank(Epoch{42})) << "our own epoch, heard back";
  EXPECT_TRUE(writer_.outrank(Epoch{50}));
  EXPECT_EQ(writer_.directive().epoch, 51U);
}

TEST_F(DirectiveWriterTest, AWithdrawalIsRepeatedAboveWhateverHelmetsFollow) {
  ASSERT_TRUE(writer_.update(plan({})));
  ASSERT_TRUE(writer_.update(MergePlan{}));
  EXPECT_TRUE(writer_.outrank(Epoch{7}));
  EXPECT_EQ(writer_.directive().epoch, 8U);
}

TEST_F(DirectiveWriterTest, AnAbsurdEpochIsNotFollowed) {
  EXPECT_FALSE(writer_.outrank(Epoch{~std::uint64_t{0}}));
  ASSERT_TRUE(writer_.update(plan({})));
  EXPECT_EQ(writer_.directive().epoch, 1U);
}

}  // namespace
}  // namespace lifeline::merging
