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

/// A picture's place that meets each limit for itself.
MatchResult place_with_lead(double second, double control, double s_overlapping) {
  MatchResult result = place_with_conflict(0.02);
  MatchCandidate next;
  next.score = second;
  result.candidates.front().s_overlapping = s_overlapping;
  result.candidates.push_back(next);
  result.control_score = control;
  judge(some_map(false), some_map(false), {}, result);
  return result;
}

TEST(AcceptanceTest, MarginMirrorImageAndAreaMayNotAllBeSmall) {
  // 30 m: 2.7 times the next place, 2.5 times the mirror image, 9.5 m2 shared.
  const MatchResult all_small = place_with_lead(11.0, 12.0, 0.0105);
  EXPECT_EQ(all_small.verdict, Verdict::wait);
  EXPECT_THAT(all_small.reason, testing::HasSubstr("stands out too little"));
  EXPECT_EQ(place_with_lead(3.0, 12.0, 0.0105).verdict, Verdict::accepted);
  EXPECT_EQ(place_with_lead(11.0, 12.0, 0.10).verdict, Verdict::accepted);
}

TEST(AcceptanceTest, TheLeadGrowsWithEachOfItsParts) {
  const double lead = place_with_lead(11.0, 12.0, 0.02).lead;
  EXPECT_GT(place_with_lead(10.0, 12.0, 0.02).lead, lead);
  EXPECT_GT(place_with_lead(11.0, 11.0, 0.02).lead, lead);
  EXPECT_GT(place_with_lead(11.0, 12.0, 0.03).lead, lead);
  // But not without end.
  EXPECT_DOUBLE_EQ(place_with_lead(0.1, 0.1, 0.02).lead, place_with_lead(0.0, 0.0, 0.02).lead);
}

TEST(AcceptanceTest, WhatIsAskedOfLayersIsLeftAsItIs) {
  MatchResult result = place_with_conflict(0.02);
  MatchCandidate next;
  next.score = 10.0;
  result.candidates.push_back(next);
  result.control_score = 14.0;
  result.candidates.front().s_overlapping = 0.0105;
  judge(some_map(true), some_map(true), {}, result);
  EXPECT_EQ(result.verdict, Verdict::accepted) << result.reason;
}

}  // namespace
}  // namespace lifeline::matching
