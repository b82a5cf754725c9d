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

TEST_F(MergeGraphTest, TheLeadIsTheFirstLayerWhoeverMergedFirst) {
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.9));
  graph_.set_edge({alpha_, charlie_}, edge({0.0, 1.0, 0.0}, 0.1));
  EXPECT_EQ(graph_.plan().groups[0][0].layer, alpha_);
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

TEST_F(MergeGraphTest, AnEdgeThatContradictsBetterOnesIsNamedAndNotFollowed) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_, 0.9));
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.8));
  graph_.set_edge({alpha_, charlie_},
                  edge(T_alpha_bravo_ * T_bravo_charlie_ * Pose2{2.0, 0.0, 0.0}, 0.3));
  const MergePlan plan = graph_.plan();
  ASSERT_EQ(plan.contradictions.size(), 1U);
  EXPECT_EQ(plan.contradictions[0].pair, (LayerPair{alpha_, charlie_}));
  EXPECT_NEAR(plan.contradictions[0].distance_m, 2.0, 1e-9);
  expect_near(plan.groups[0][2].T_common_map, T_alpha_bravo_ * T_bravo_charlie_);
}

TEST_F(MergeGraphTest, AnEdgeThatAgreesIsNoContradiction) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_, 0.9));
  graph_.set_edge({bravo_, charlie_}, edge(T_bravo_charlie_, 0.8));
  graph_.set_edge({alpha_, charlie_},
                  edge(T_alpha_bravo_ * T_bravo_charlie_ * Pose2{0.05, 0.0, 0.01}, 0.3));
  EXPECT_TRUE(graph_.plan().contradictions.empty());
}

TEST_F(MergeGraphTest, AWithdrawnEdgeSplitsItsGroup) {
  graph_.set_edge({alpha_, bravo_}, edge(T_alpha_bravo_));
  graph_.withdraw({alpha_, bravo_});
  EXPECT_TRUE(graph_.plan().groups.empty());
}

}  // namespace
}  // namespace lifeline::merging
