#include "coordinator/merging/merge_keeper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using matching::Verdict;
using test::layer;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MergeKeeperTest : public testing::Test {
 protected:
  /// So much wall that one match is enough.
  static PairMatch accepted(const Pose2& T_a_b) {
    PairMatch match;
    match.result.verdict = Verdict::accepted;
    match.result.reason = "fits";
    matching::MatchCandidate best;
    best.T_a_b = T_a_b;
    best.agreeing_wall_m = best.score = 70.0;
    match.result.candidates = {best};
    match.result.covariance = Eigen::Matrix3d::Identity() * 1e-6;
    return match;
  }
  static PairMatch waiting(const Pose2& T_checked, double conflict) {
    PairMatch match;
    match.result.reason = "two places fit";
    match.check = PlaceCheck{};
    match.check->figures.T_a_b = T_checked;
    match.check->figures.agreeing_wall_m = 20.0;
    match.check->figures.conflict = conflict;
    match.check->conflict_m = 20.0 * conflict / (1.0 - conflict);
    return match;
  }

  static PairMatch undecided() {
    PairMatch match;
    match.result.reason = "two places fit";
    return match;
  }
  void take(const LayerPair& pair, const PairMatch& match) { (void)keeper_.take(pair, match); }

  LayerKey alpha_ = layer("alpha"), bravo_ = layer("bravo"), charlie_ = layer("charlie");
  LayerPair alpha_bravo_{alpha_, bravo_}, alpha_charlie_{alpha_, charlie_},
      bravo_charlie_{bravo_, charlie_};
  Pose2 T_alpha_bravo_{1.0, 2.0, 0.5}, T_alpha_charlie_{-3.0, 0.5, -1.2};
  Pose2 T_bravo_charlie_ = T_alpha_bravo_.inverse() * T_alpha_charlie_;
  MergeKeeper keeper_;
};

TEST_F(MergeKeeperTest, APairThatAGroupLaysOnEachOtherIsToBeLookedAtThere) {
  EXPECT_FALSE(keeper_.place_to_check(bravo_charlie_));
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_charlie_, accepted(T_alpha_charlie_));
  EXPECT_THAT(keeper_.unchecked(), ElementsAre(bravo_charlie_));
  const auto place = keeper_.place_to_check(bravo_charlie_);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_m, T_bravo_charlie_.x_m, 1e-9);
  take(bravo_charlie_, waiting(*place, 0.05));
  EXPECT_THAT(keeper_.unchecked(), IsEmpty());
  EXPECT_EQ(keeper_.plan().groups[0].size(), 3U);
}

TEST_F(MergeKeeperTest, WhereNobodyCouldLookIsNotAskedForAgain) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_charlie_, accepted(T_alpha_charlie_));
  take(bravo_charlie_, PairMatch{});
  EXPECT_THAT(keeper_.unchecked(), IsEmpty());
}

TEST_F(MergeKeeperTest, WallsThatContradictThereAreAnObjectionThatIsNews) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_charlie_, accepted(T_alpha_charlie_));
  const auto news = keeper_.take(bravo_charlie_, waiting(T_bravo_charlie_, 0.3));
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(news[0].pair, bravo_charlie_);
  EXPECT_EQ(news[1].verdict, Verdict::wait);
  EXPECT_THAT(news[1].reason,
              HasSubstr("would lay bravo-charlie so that 8.6 m of wall contradict"));
  EXPECT_EQ(keeper_.plan().groups[0].size(), 2U);
  EXPECT_FALSE(keeper_.follows(news[1].pair));
}

TEST_F(MergeKeeperTest, AnObjectionStandsUntilClearlyLessWallContradicts) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_charlie_, accepted(T_alpha_charlie_));
  take(bravo_charlie_, waiting(T_bravo_charlie_, 0.3));
  EXPECT_TRUE(keeper_.place_to_check(bravo_charlie_)) << "to see whether it still stands";
  take(bravo_charlie_, waiting(T_bravo_charlie_, 0.17));
  EXPECT_EQ(keeper_.plan().groups[0].size(), 2U);
  const auto news = keeper_.take(bravo_charlie_, waiting(T_bravo_charlie_, 0.1));
  EXPECT_EQ(keeper_.plan().groups[0].size(), 3U);
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(news[1].verdict, Verdict::accepted);
  EXPECT_THAT(news[1].reason, HasSubstr("followed again"));
}

TEST_F(MergeKeeperTest, AContradictionIsToldOnceAndNotAtEveryMatch) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_charlie_, accepted(T_alpha_charlie_));
  const auto news = keeper_.take(bravo_charlie_, accepted(T_bravo_charlie_ * Pose2{2, 0, 0}));
  // Of three edges that disagree round a cycle one is followed, and the other two are told.
  ASSERT_EQ(news.size(), 2U);
  EXPECT_THAT(news[0].reason, HasSubstr("not followed: "));
  EXPECT_THAT(news[1].reason, HasSubstr("not followed: "));
  EXPECT_NE(news[0].pair, news[1].pair);
  EXPECT_EQ(keeper_.take(alpha_bravo_, accepted(T_alpha_bravo_)).size(), 1U);
}

TEST_F(MergeKeeperTest, WhyAPairWasPartedIsSaidUntilItIsMergedAgain) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  take(alpha_bravo_, waiting(T_alpha_bravo_, 0.3));
  EXPECT_THAT(keeper_.take(alpha_bravo_, waiting(T_alpha_bravo_, 0.3)).front().reason,
              HasSubstr("withdrawn: where the maps were merged 30 %"));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(keeper_.take(alpha_bravo_, undecided()).front().reason,
              "two places fit; merged before, then withdrawn: where the maps were merged 30 % of "
              "the wall contradict now");
  }
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  EXPECT_EQ(keeper_.take(alpha_bravo_, accepted(T_alpha_bravo_)).front().reason, "fits");
}

TEST_F(MergeKeeperTest, TheLeadStaysWhenASmallerNameJoins) {
  take(bravo_charlie_, accepted(T_bravo_charlie_));
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  EXPECT_EQ(keeper_.plan().groups[0].size(), 3U);
  EXPECT_EQ(keeper_.plan().groups[0].front().layer, bravo_);
}

TEST_F(MergeKeeperTest, NoMatchMergesWhatAPersonParted) {
  take(alpha_bravo_, accepted(T_alpha_bravo_));
  const auto news = keeper_.part_by_hand(alpha_bravo_);
  EXPECT_EQ(news.front().reason, "withdrawn by hand");
  EXPECT_THAT(keeper_.plan().groups, IsEmpty());
  const auto again = keeper_.take(alpha_bravo_, accepted(T_alpha_bravo_));
  EXPECT_EQ(again.front().verdict, Verdict::rejected);
  EXPECT_THAT(again.front().reason, HasSubstr("withdrawn by hand; this match: fits"));
  EXPECT_FALSE(keeper_.follows(alpha_bravo_));
  MergeKeeper restarted;
  restarted.adopt(keeper_.graph().edges(), keeper_.parted_by_hand());
  (void)restarted.take(alpha_bravo_, accepted(T_alpha_bravo_));
  EXPECT_FALSE(restarted.follows(alpha_bravo_));
}

TEST_F(MergeKeeperTest, NoMatchPartsWhatAPersonMerged) {
  MergeEdge edge = to_edge(accepted(T_alpha_bravo_).result);
  EXPECT_EQ(keeper_.merge_by_hand(alpha_bravo_, edge).front().verdict, Verdict::accepted);
  for (int i = 0; i < 4; ++i) take(alpha_bravo_, waiting(T_alpha_bravo_, 0.4));
  EXPECT_TRUE(keeper_.follows(alpha_bravo_));
  take(alpha_bravo_, accepted({9.0, 9.0, 0.0}));
  take(alpha_bravo_, accepted({9.0, 9.0, 0.0}));
  ASSERT_TRUE(keeper_.plan().T_a_b(alpha_bravo_));
  EXPECT_NEAR(keeper_.plan().T_a_b(alpha_bravo_)->x_m, T_alpha_bravo_.x_m, 1e-9);
  (void)keeper_.part_by_hand(alpha_bravo_);
  EXPECT_FALSE(keeper_.follows(alpha_bravo_));
}

}  // namespace
}  // namespace lifeline::merging
