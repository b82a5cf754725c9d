#include "coordinator/matching/acceptance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::matching {
namespace {

/// Features of which only the existence of walls matters here.
MapFeatures some_map(bool weighed) {
  MapFeatures features;
  features.walls.resize(1);
  features.weighed = weighed;
  return features;
}

/// A place that meets every other criterion by far.
MatchResult place_with_conflict(double conflict) {
  MatchResult result;
  MatchCandidate best;
  best.agreeing_wall_m = 40.0;
  best.conflict = conflict;
  best.constraint_m = 15.0;
  best.score = 30.0;
  best.s_overlapping = 0.2;
  best.acceptance_index = 0.95;
  result.candidates = {best};
  return result;
}

MatchResult judged(const MapFeatures& a, const MapFeatures& b, double conflict) {
  MatchResult result = place_with_conflict(conflict);
  judge(a, b, {}, result);
  return result;
}

TEST(AcceptanceTest, APictureMayContradictMoreThanALayerThatTellsHowWellItSaw) {
  const MapFeatures layer = some_map(true), picture = some_map(false);
  EXPECT_EQ(judged(picture, picture, 0.06).verdict, Verdict::accepted);
  EXPECT_EQ(judged(layer, picture, 0.06).verdict, Verdict::accepted);
  const MatchResult layers = judged(layer, layer, 0.06);
  EXPECT_EQ(layers.verdict, Verdict::rejected);
  EXPECT_THAT(layers.reason, testing::HasSubstr("6 % of the wall at the best place stands in"));
  EXPECT_THAT(layers.reason, testing::HasSubstr("at most 5 % may"));
}

TEST(AcceptanceTest, LayersThatHardlyContradictAreAccepted) {
  EXPECT_EQ(judged(some_map(true), some_map(true), 0.03).verdict, Verdict::accepted);
}

}  // namespace
}  // namespace lifeline::matching
