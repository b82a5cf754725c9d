#include "coordinator/storage/merge_records.hpp"

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline {
namespace {

using test::layer;

merging::EdgeMap some_edges() {
  merging::EdgeMap edges;
  Eigen::Matrix3d covariance;
  covariance << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  edges[{layer("alpha", 1, -2), layer("bravo", 7, -2)}] = {
      {1.5, -2.5, 0.75}, covariance, 0.25, {3.0, -4.0}, false};
  edges[{layer("alpha"), layer("charlie")}] = {{}, Eigen::Matrix3d::Zero(), 1.0, {0.0, 0.0}, false};
  return edges;
}

TEST(MergeRecords, GiveTheSameEdges) {
  const auto edges = some_edges();
  const auto read = read_merges({{kMergesKey, merges_record(edges)}});
  ASSERT_TRUE(read) << read.error().text;
  ASSERT_EQ(read->edges.size(), edges.size());
  for (const auto& [pair, edge] : edges) {
    const auto& again = read->edges.at(pair);
    EXPECT_EQ(again.T_a_b.x_m, edge.T_a_b.x_m);
    EXPECT_EQ(again.T_a_b.y_m, edge.T_a_b.y_m);
    EXPECT_EQ(again.T_a_b.yaw_rad, edge.T_a_b.yaw_rad);
    EXPECT_EQ(again.covariance, edge.covariance);
    EXPECT_EQ(again.quality, edge.quality);
    EXPECT_EQ(again.overlap_centre_b_m, edge.overlap_centre_b_m);
    EXPECT_EQ(again.by_hand, edge.by_hand);
  }
  EXPECT_TRUE(read_merges({})->edges.empty());
}

TEST(MergeRecords, HoldWhatAPersonDecided) {
  auto edges = some_edges();
  edges.begin()->second.by_hand = true;
  const std::set<merging::LayerPair> apart{{layer("bravo"), layer("charlie")}};
  const auto read = read_merges({{kMergesKey, merges_record(edges, apart)}});
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(read->apart, apart);
  EXPECT_TRUE(read->edges.begin()->second.by_hand);
}

TEST(MergeRecords, OfWhatMakesNoMergeAreRefused) {
  EXPECT_FALSE(read_merges({{kMergesKey, "\xff\xff"}}));
  for (const auto spoil : std::initializer_list<void (*)(merging::MergeEdge&)>{
           [](merging::MergeEdge& edge) { edge.T_a_b.x_m = std::nan(""); },
           [](merging::MergeEdge& edge) { edge.T_a_b.y_m = 1e9; },
           [](merging::MergeEdge& edge) { edge.covariance(0, 0) = -1.0; },
           [](merging::MergeEdge& edge) { edge.quality = 1.5; }}) {
    auto edges = some_edges();
    spoil(edges.begin()->second);
    EXPECT_FALSE(read_merges({{kMergesKey, merges_record(edges)}}));
  }
}

}  // namespace
}  // namespace lifeline
