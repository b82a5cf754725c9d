#include "coordinator/merging/merge_graph.hpp"

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

using test::layer;

MergeEdge edge(const Pose2& T_a_b, double quality = 0.5) {
  return {T_a_b, Eigen::Matrix3d::Identity() * 1e-4, quality};
}

void expect_near(const Pose2& actual, const Pose2& expected) {
  EXPECT_NEAR(actual.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(actual.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(normalise_angle(actual.yaw_rad - expected.yaw_rad), 0.0, 1e-9);
}

class MergeGraphTest : public testing::Test {
 protected:
  LayerKey alpha_ = layer("alpha"), bravo_ = layer("bravo"), charlie_ = layer("charlie"),
           delta_ = layer("delta");
  Pose2 T_alpha_bravo_{1.0, 2.0, 0.5}, T_bravo_charlie_{-3.0, 0.5, -1.2};
  MergeGraph graph_;
};

TEST_F(MergeGraphTest, NoEdgesMeanNoGroups) {
  EXPECT_TRUE(graph_.plan().groups.empty());
}

TEST_F(MergeGraphTest, PlacesAreChainedFromTheLead) {
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_));
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups.size(), 1U);
  ASSERT_EQ(plan.groups[0].size(), 3U);
  EXPECT_EQ(plan.groups[0][0].layer, alpha_);
  expect_near(plan.groups[0][0].T_common_map, {});
  expect_near(plan.groups[0][1].T_common_map, T_alpha_bravo_);
  expect_near(plan.groups[0][2].T_common_map, T_alpha_bravo_ * T_bravo_charlie_);
  EXPECT_GT(plan.groups[0][2].covariance(0, 0), plan.groups[0][1].covariance(0, 0));
}

TEST_F(MergeGraphTest, WithoutAFormerLeadTheFirstLayerLeads) {
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.9));
  graph_.set_edge({alpha_, charlie_}, edge({0.0, 1.0, 0.0}, 0.1));
  EXPECT_EQ(graph_.plan().groups[0][0].layer, alpha_);
}

TEST_F(MergeGraphTest, AGroupKeepsItsLeadWhenALayerWithASmallerNameJoins) {
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.9));
  graph_.set_edge({alpha_, charlie_}, edge({0.0, 1.0, 0.0}, 0.1));
  const MergePlan plan = graph_.plan({bravo_});
  EXPECT_EQ(plan.groups[0][0].layer, bravo_);
  expect_near(plan.groups[0][0].T_common_map, {});
  expect_near(plan.groups[0][2].T_common_map, T_bravo_charlie_);
}

TEST_F(MergeGraphTest, WhereGroupsConnectTheFirstOfTheFormerLeadsLeads) {
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.9));
  graph_.set_edge({alpha_, charlie_}, edge({0.0, 1.0, 0.0}, 0.1));
  EXPECT_EQ(graph_.plan({charlie_, alpha_}).groups[0][0].layer, charlie_);
}

TEST_F(MergeGraphTest, SeparatePairsStaySeparateGroupsLargestFirst) {
  const LayerKey echo = layer("echo");
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_));
  graph_.set_edge({charlie_, delta_}, edge({}));
  graph_.set_edge({delta_, echo}, edge({}));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups.size(), 2U);
  EXPECT_EQ(plan.groups[0].size(), 3U);
  EXPECT_EQ(plan.groups[0][0].layer, charlie_);
  EXPECT_EQ(plan.groups[1][0].layer, alpha_);
}

TEST_F(MergeGraphTest, AWeakEdgeThatContradictsMuchStrongerOnesIsNamedAndNotFollowed) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_, 0.9));
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.8));
  graph_.set_edge({alpha_, charlie_},
                  edge(T_alpha_bravo_ * T_bravo_charlie_ * Pose2{1.2, 0.0, 0.07}, 0.3));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.contradictions.size(), 1U);
  EXPECT_EQ(plan.contradictions[0].pair, (LayerPair{alpha_, charlie_}));
  EXPECT_NEAR(plan.contradictions[0].distance_m, 1.2, 1e-9);
  EXPECT_EQ(describe(plan.contradictions[0]),
            "contradicts alpha-bravo and bravo-charlie by 1.2 m, 4 deg");
  expect_near(plan.groups[0][2].T_common_map, T_alpha_bravo_ * T_bravo_charlie_);
}

TEST_F(MergeGraphTest, ThreeEdgesThatContradictEachOtherLeaveTheStrongestPair) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_, 0.7));
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.65));
  graph_.set_edge({alpha_, charlie_},
                  edge(T_alpha_bravo_ * T_bravo_charlie_ * Pose2{2.0, 0.0, 0.0}, 0.6));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups.size(), 1U);
  EXPECT_EQ(plan.groups[0].size(), 2U);
  EXPECT_EQ(plan.groups[0][1].layer, bravo_);
  ASSERT_EQ(plan.contradictions.size(), 2U);
  EXPECT_EQ(describe(plan.contradictions[0]),
            "contradicts bravo-charlie by 2.0 m, 0 deg, and no third match decides between them");
  EXPECT_EQ(plan.contradictions[1].against, (std::vector<LayerPair>{{alpha_, charlie_}}));
}

/// alpha, bravo and charlie confirm each other.
class TrustedTriangleTest : public MergeGraphTest {
 protected:
  TrustedTriangleTest() {
    graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_));
    graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_));
    graph_.set_edge({alpha_, charlie_}, edge(T_alpha_bravo_ * T_bravo_charlie_));
  }
  [[nodiscard]] MergeEdge delta_from(const LayerKey& layer, const Pose2& T_alpha_delta,
                                     double quality = 0.5) const {
    const Pose2 T_layer_alpha = layer == bravo_     ? T_alpha_bravo_.inverse()
                                : layer == charlie_ ? (T_alpha_bravo_ * T_bravo_charlie_).inverse()
                                                    : Pose2{};
    return edge(T_layer_alpha * T_alpha_delta, quality);
  }
  Pose2 T_alpha_delta_{4.0, -1.0, 2.0}, T_wrong_{-2.0, 3.0, 0.4}, T_other_{0.0, 9.0, -2.0};
};

TEST_F(TrustedTriangleTest, AFourthWithOneEdgeIsFollowed) {
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_));
  const MergePlan plan = graph_.plan();
  EXPECT_EQ(plan.groups[0].size(), 4U);
  EXPECT_TRUE(plan.contradictions.empty());
}

TEST_F(TrustedTriangleTest, AFourthWhoseEdgesAllContradictEachOtherStaysOut) {
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_, 0.6));
  graph_.set_edge({bravo_, delta_}, delta_from(bravo_, T_wrong_, 0.55));
  graph_.set_edge({charlie_, delta_}, delta_from(charlie_, T_other_, 0.5));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups.size(), 1U);
  EXPECT_EQ(plan.groups[0].size(), 3U);
  EXPECT_EQ(plan.contradictions.size(), 3U);
  for (const auto& contradiction : plan.contradictions)
    EXPECT_EQ(contradiction.why, Contradiction::Why::in_doubt);
}

TEST_F(TrustedTriangleTest, AFourthThatTwoEdgesHoldIsFollowedAgainstAStrongerOne) {
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_, 0.5));
  graph_.set_edge({bravo_, delta_}, delta_from(bravo_, T_wrong_, 0.85));
  graph_.set_edge({charlie_, delta_}, delta_from(charlie_, T_alpha_delta_, 0.5));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups[0].size(), 4U);
  expect_near(plan.groups[0][3].T_common_map, T_alpha_delta_);
  ASSERT_EQ(plan.contradictions.size(), 1U);
  EXPECT_EQ(plan.contradictions[0].why, Contradiction::Why::outvoted);
  EXPECT_EQ(plan.contradictions[0].pair, (LayerPair{bravo_, delta_}));
}

TEST_F(TrustedTriangleTest, WallsThatContradictWhereOneEdgeLaysThemPartItAgain) {
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_));
  const Pose2 T_bravo_delta = delta_from(bravo_, T_alpha_delta_).T_a_b;
  graph_.object({bravo_, delta_}, {T_bravo_delta, {1.0, 1.0}, 0.3, 6.0});
  MergePlan plan = graph_.plan();
  EXPECT_EQ(plan.groups[0].size(), 3U);
  ASSERT_EQ(plan.contradictions.size(), 1U);
  EXPECT_EQ(describe(plan.contradictions[0]),
            "would lay bravo-delta so that 6.0 m of wall contradict");
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_other_));
  plan = graph_.plan();
  EXPECT_EQ(plan.groups[0].size(), 4U) << "the objection was to another place";
}

TEST_F(MergeGraphTest, AnEdgeThatAgreesIsNoContradiction) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_, 0.9));
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.8));
  graph_.set_edge({alpha_, charlie_},
                  edge(T_alpha_bravo_ * T_bravo_charlie_ * Pose2{0.05, 0.0, 0.01}, 0.3));
  EXPECT_TRUE(graph_.plan().contradictions.empty());
}

TEST_F(MergeGraphTest, EveryEdgeThatAgreesHasItsSayInThePlaces) {
  graph_.set_edge({alpha_, bravo_}, edge({1.0, 0.0, 0.0}));
  graph_.set_edge({bravo_, charlie_}, edge({1.0, 0.0, 0.0}));
  graph_.set_edge({alpha_, charlie_}, edge({2.09, 0.0, 0.0}));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups[0].size(), 3U);
  EXPECT_NEAR(plan.groups[0][1].T_common_map.x_m, 1.03, 1e-3);
  EXPECT_NEAR(plan.groups[0][2].T_common_map.x_m, 2.06, 1e-3);
  const double one_edge = 1e-4 + 0.05 * 0.05;  // what is measured and what is believed besides
  EXPECT_NEAR(plan.groups[0][2].covariance(0, 0), one_edge * 2 / 3, 1e-4);
}

TEST_F(MergeGraphTest, AWithdrawnEdgeSplitsItsGroup) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_));
  graph_.withdraw({alpha_, bravo_});
  EXPECT_TRUE(graph_.plan().groups.empty());
}

TEST_F(TrustedTriangleTest, WhoSeveralOthersObjectToIsPartedAndNotTheOthers) {
  // bravo hangs on alpha by a weaker edge than delta does.
  graph_.withdraw({bravo_, charlie_});
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_, 0.9));
  for (const LayerKey& layer : {bravo_, charlie_})
    graph_.object({layer, delta_}, {delta_from(layer, T_alpha_delta_).T_a_b, {1, 1}, 0.3, 6.0});
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups[0].size(), 3U);
  EXPECT_EQ(plan.groups[0][2].layer, charlie_);
}

TEST_F(TrustedTriangleTest, WhoseOtherEdgeIsInDoubtIsPartedBeforeWhoseIsNot) {
  graph_.withdraw({bravo_, charlie_});
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_, 0.9));
  graph_.set_edge({charlie_, delta_}, delta_from(charlie_, T_alpha_delta_, 0.9));
  graph_.set_doubted({charlie_, delta_}, true);
  graph_.object({bravo_, delta_}, {delta_from(bravo_, T_alpha_delta_).T_a_b, {1, 1}, 0.3, 6.0});
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.groups[0].size(), 3U);
  EXPECT_EQ(plan.groups[0][2].layer, charlie_);
}

TEST_F(TrustedTriangleTest, OneObjectionDoesNotPartWhomTwoEdgesHold) {
  graph_.set_edge({alpha_, delta_}, delta_from(alpha_, T_alpha_delta_));
  graph_.set_edge({charlie_, delta_}, delta_from(charlie_, T_alpha_delta_));
  graph_.object({bravo_, delta_}, {delta_from(bravo_, T_alpha_delta_).T_a_b, {1, 1}, 0.3, 6.0});
  EXPECT_EQ(graph_.plan().groups[0].size(), 4U);
}

}  // namespace
}  // namespace lifeline::merging
