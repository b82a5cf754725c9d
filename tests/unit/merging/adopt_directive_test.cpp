#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "coordinator/merging/directive_writer.hpp"
#include "coordinator/merging/merge_keeper.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using test::layer;

class AdoptDirectiveTest : public testing::Test {
 protected:
  static wire::DirectiveMember member(const std::string& id, std::uint16_t group,
                                      const Pose2& T_common_map) {
    return {{id, 1, 0}, group, sharing::to_fixed(T_common_map), {1e-4, 0, 0, 1e-4, 0, 1e-6}, 0.8F};
  }
  /// Charlie leads alpha and delta; bravo leads echo.
  static wire::MergeDirective directive() {
    wire::MergeDirective directive;
    directive.mission_id = test::kMission;
    directive.epoch = 41;
    directive.members = {member("charlie", 0, {}), member("alpha", 0, {1.0, 2.0, 0.5}),
                         member("delta", 0, {-3.0, 0.5, -1.2}), member("bravo", 1, {}),
                         member("echo", 1, {4.0, 0.0, 3.0})};
    return directive;
  }
  static Pose2 apart(const Pose2& a, const Pose2& b) { return a.inverse() * b; }

  MergeKeeper keeper_;
  DirectiveWriter writer_{{}, test::kMission};
};

TEST_F(AdoptDirectiveTest, NothingMovesAndNobodyChangesTheFrame) {
  ASSERT_TRUE(writer_.adopt(directive()));
  keeper_.adopt(directive());
  const MergePlan& plan = keeper_.plan();
  ASSERT_EQ(plan.groups.size(), 2U);
  EXPECT_EQ(plan.groups[0].front().layer, layer("charlie"));
  EXPECT_EQ(plan.groups[1].front().layer, layer("bravo"));
  const auto T = plan.T_a_b({layer("alpha"), layer("charlie")});
  ASSERT_TRUE(T);
  const Pose2 off = apart(*T, Pose2{1.0, 2.0, 0.5}.inverse());
  EXPECT_LT(off.translation().norm(), 1e-5);
  EXPECT_FALSE(writer_.update(plan)) << "what was adopted is what is planned";
  EXPECT_EQ(writer_.directive().epoch, 41U);
}

TEST_F(AdoptDirectiveTest, OwnMergesStandWhereTheyHoldAMember) {
  const LayerPair pair{layer("alpha"), layer("charlie")};
  EdgeMap edges;
  edges[pair] = {Pose2{1.0, 2.0, 0.5}.inverse(), Eigen::Matrix3d::Identity() * 1e-6, 0.9};
  keeper_.adopt(edges);
  keeper_.adopt(directive());
  EXPECT_EQ(keeper_.graph().edge(pair)->quality, 0.9);
  EXPECT_NE(keeper_.graph().edge({layer("charlie"), layer("delta")}), nullptr);
  EXPECT_EQ(keeper_.plan().groups[0].size(), 3U);
}

TEST_F(AdoptDirectiveTest, AMatchReplacesWhatWasAdopted) {
  keeper_.adopt(directive());
  PairMatch match;
  match.result.verdict = matching::Verdict::accepted;
  matching::MatchCandidate best;
  best.T_a_b = Pose2{1.02, 2.0, 0.5}.inverse();
  best.agreeing_wall_m = best.score = 70.0;
  match.result.candidates = {best};
  match.result.covariance = Eigen::Matrix3d::Identity() * 1e-6;
  const LayerPair pair{layer("alpha"), layer("charlie")};
  (void)keeper_.take(pair, match);
  EXPECT_GT(keeper_.graph().edge(pair)->quality, 0.8);
  EXPECT_LT(apart(keeper_.graph().edge(pair)->T_a_b, best.T_a_b).translation().norm(), 1e-9);
}

TEST_F(AdoptDirectiveTest, ValuesThatAreNoCovarianceBreakNothing) {
  wire::MergeDirective broken = directive();
  broken.members[1].covariance = {-1, std::nan(""), 0, 1e300, 0, 0};
  broken.members[2].quality = std::nanf("");
  keeper_.adopt(broken);
  ASSERT_EQ(keeper_.plan().groups.size(), 2U);
  for (const Membership& member : keeper_.plan().groups[0]) {
    EXPECT_TRUE(member.T_common_map.is_finite());
  }
}

TEST_F(AdoptDirectiveTest, OnlyWhatIsNewerIsAdopted) {
  EXPECT_FALSE(writer_.renew(Epoch{40})) << "nothing to say yet";
  ASSERT_TRUE(writer_.adopt(directive()));
  EXPECT_FALSE(writer_.adopt(directive()));
  wire::MergeDirective older = directive();
  older.epoch = 40;
  older.members.clear();
  EXPECT_FALSE(writer_.adopt(older));
  EXPECT_EQ(writer_.directive().members.size(), 5U);
}

TEST_F(AdoptDirectiveTest, WhatIsSaidAgainOutranksWhatWasHeard) {
  ASSERT_TRUE(writer_.adopt(directive()));
  ASSERT_TRUE(writer_.renew(Epoch{40}));
  EXPECT_EQ(writer_.directive().epoch, 42U);
  ASSERT_TRUE(writer_.renew(Epoch{50}));
  EXPECT_EQ(writer_.directive().epoch, 51U);
  ASSERT_TRUE(writer_.renew(Epoch{1'000'000'000'000}));
  EXPECT_EQ(writer_.directive().epoch, 52U) << "a hostile epoch is not followed";
}

}  // namespace
}  // namespace lifeline::merging
