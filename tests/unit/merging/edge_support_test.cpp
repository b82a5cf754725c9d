#include "coordinator/merging/edge_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using matching::Verdict;
using test::layer;
using testing::HasSubstr;

class EdgeSupportTest : public testing::Test {
 protected:
  [[nodiscard]] PairMatch accepted(const Pose2& T_a_b, double wall_m = 20.0) const {
    PairMatch match;
    match.result.verdict = Verdict::accepted;
    matching::MatchCandidate best;
    best.T_a_b = T_a_b;
    best.agreeing_wall_m = wall_m;
    match.result.candidates = {best};
    match.result.overlap_centre_b_m = {5.0, 0.0};
    return match;
  }
  /// Not accepted; at the held place so much wall agrees and contradicts.
  [[nodiscard]] PairMatch undecided(double agreeing_m, double conflict) const {
    PairMatch match;
    match.result.verdict = Verdict::rejected;
    match.check = PlaceCheck{};
    match.check->figures.agreeing_wall_m = agreeing_m;
    match.check->figures.conflict = conflict;
    match.check->conflict_m = agreeing_m * conflict / (1.0 - conflict);
    return match;
  }
  /// The same where `share` of the contradicting wall is only displaced.
  [[nodiscard]] PairMatch bent(double conflict, double share) const {
    PairMatch match = undecided(20.0, conflict);
    match.check->displaced_m = share * match.check->conflict_m;
    return match;
  }
  EdgeStep judge(const PairMatch& match, bool held = true) {
    const MergeEdge edge{T_, Eigen::Matrix3d::Identity(), 0.6};
    decision_ = support_.judge(pair_, match, held ? &edge : nullptr);
    return decision_.step;
  }
  void merge() {
    ASSERT_EQ(judge(accepted(T_), false), EdgeStep::proposed);
    ASSERT_EQ(judge(accepted(T_), false), EdgeStep::adopted);
  }

  LayerPair pair_{layer("alpha"), layer("bravo")};
  Pose2 T_{1.0, 2.0, 0.5}, T_near_ = T_ * Pose2{0.1, 0.0, 0.01}, T_far_{4.0, 2.0, 0.5};
  EdgeSupport support_;
  EdgeDecision decision_;
};

TEST_F(EdgeSupportTest, AMatchNearTheHeldPlaceRefinesItAtOnce) {
  merge();
  EXPECT_EQ(judge(accepted(T_near_)), EdgeStep::refined);
}

TEST_F(EdgeSupportTest, AMatchElsewhereRaisesADoubtAndTheNextThatAgreesMovesTheEdge) {
  merge();
  EXPECT_EQ(judge(accepted(T_far_)), EdgeStep::doubted);
  EXPECT_TRUE(support_.in_doubt(pair_));
  EXPECT_EQ(judge(accepted(T_far_)), EdgeStep::adopted);
  EXPECT_THAT(decision_.reason, HasSubstr("moved: fits 3.0 m, 0 deg from where"));
  EXPECT_FALSE(support_.in_doubt(pair_));
}

TEST_F(EdgeSupportTest, AMatchElsewhereOnMapsThatWillNotChangeMovesTheEdge) {
  merge();
  PairMatch last = accepted(T_far_);
  last.last_chance = true;
  EXPECT_EQ(judge(last), EdgeStep::adopted);
}

TEST_F(EdgeSupportTest, TwoMatchesAtTwoOtherPlacesEndTheEdge) {
  merge();
  EXPECT_EQ(judge(accepted(T_far_)), EdgeStep::doubted);
  EXPECT_EQ(judge(accepted({-9.0, 0.0, 2.0})), EdgeStep::withdrawn);
  EXPECT_THAT(decision_.reason, HasSubstr("withdrawn: the best place is"));
}

TEST_F(EdgeSupportTest, AMatchThatDecidesNothingKeepsAnEdgeWhoseWallsStillAgree) {
  merge();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(judge(undecided(19.0, 0.05)), EdgeStep::kept);
}

TEST_F(EdgeSupportTest, ABentMapKeepsAnEdgeWhoseContradictingWallIsOnlyDisplaced) {
  merge();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(judge(bent(0.22, 0.7)), EdgeStep::kept);
  EXPECT_EQ(decision_.reason,
            "a map is bent: of 22 % of the wall that contradict, 70 % are only displaced by less "
            "than 1 m");
}

TEST_F(EdgeSupportTest, DisplacedWallDoesNotKeepAnEdgeThatOtherWallContradicts) {
  merge();
  EXPECT_EQ(judge(bent(0.22, 0.5)), EdgeStep::doubted);
  EXPECT_EQ(judge(bent(0.22, 0.5)), EdgeStep::withdrawn);
}

TEST_F(EdgeSupportTest, OneMatchWithoutSupportIsForgottenOnceTheNextSupports) {
  merge();
  EXPECT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::doubted);
  EXPECT_EQ(judge(accepted(T_near_)), EdgeStep::refined);
  EXPECT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::doubted);
}

TEST_F(EdgeSupportTest, TwoInARowThatContradictEndTheEdge) {
  merge();
  EXPECT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::doubted);
  EXPECT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::withdrawn);
  EXPECT_EQ(decision_.reason,
            "withdrawn: where the maps were merged 30 % of the wall contradict now");
}

TEST_F(EdgeSupportTest, TwoInARowThatFindLittleOfTheAgreementEndTheEdge) {
  merge();
  EXPECT_EQ(judge(undecided(9.0, 0.0)), EdgeStep::doubted);
  EXPECT_EQ(judge(undecided(9.0, 0.0)), EdgeStep::withdrawn);
}

TEST_F(EdgeSupportTest, OneThatContradictsOnMapsThatWillNotChangeEndsTheEdge) {
  merge();
  PairMatch last = undecided(15.0, 0.3);
  last.last_chance = true;
  EXPECT_EQ(judge(last), EdgeStep::withdrawn);
}

TEST_F(EdgeSupportTest, ALittleContradictingWallIsADoorAndNoDoubt) {
  merge();
  EXPECT_EQ(judge(undecided(10.5, 0.15)), EdgeStep::kept);
}

TEST_F(EdgeSupportTest, AWithdrawnEdgeNeedsTwoMatchesAgain) {
  merge();
  ASSERT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::doubted);
  ASSERT_EQ(judge(undecided(15.0, 0.3)), EdgeStep::withdrawn);
  EXPECT_EQ(judge(accepted(T_), false), EdgeStep::proposed);
}

}  // namespace
}  // namespace lifeline::merging
