#include "agents/sharing/own_detections.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using wire::DetectionKind;

MapSighting sighting(double x_m, double y_m, int second = 1,
                     DetectionKind kind = DetectionKind::victim) {
  return {kind, {x_m, y_m}, 0.1, 0.8, Timestamp(std::chrono::seconds(second))};
}

TEST(OwnDetections, RepeatedSightingsAreOneFindAtTheirMean) {
  OwnDetections finds;
  for (int i = 0; i < 10; ++i) finds.note(sighting(3.0 + (i % 2 == 0 ? 0.2 : -0.2), 1.0, 10 + i));
  ASSERT_EQ(finds.all().size(), 1U);
  const OwnDetection& find = finds.all()[0];
  EXPECT_NEAR(find.p_map_m.x(), 3.0, 1e-9);
  EXPECT_NEAR(find.p_map_m.y(), 1.0, 1e-9);
  EXPECT_EQ(find.first_seen, Timestamp(std::chrono::seconds(10)));
  EXPECT_EQ(find.seen, Timestamp(std::chrono::seconds(19)));
  EXPECT_EQ(find.sightings, 10U);
}

TEST(OwnDetections, AnExactSightingCountsForMoreThanARoughOne) {
  OwnDetections finds;
  MapSighting rough = sighting(0.0, 0.0), exact = sighting(0.9, 0.0);  // within 1 m
  rough.sigma_m = 0.3;
  finds.note(rough);
  finds.note(exact);
  EXPECT_NEAR(finds.all().at(0).p_map_m.x(), 0.81, 1e-9);  // 9 of 10 parts
}

TEST(OwnDetections, WhatLiesApartOrIsOfAnotherKindIsAnotherFind) {
  OwnDetections finds;
  finds.note(sighting(0.0, 0.0));
  finds.note(sighting(1.01, 0.0));
  finds.note(sighting(0.0, 0.0, 1, DetectionKind::uwb_tag));
  EXPECT_EQ(finds.all().size(), 3U);
}

TEST(OwnDetections, ARoughSightingBelongsToAFindFartherAway) {
  OwnDetections finds;
  for (int i = 0; i < 100; ++i) finds.note(sighting(0.0, 0.0));
  MapSighting rough = sighting(1.3, 0.0);
  rough.sigma_m = 0.35;
  finds.note(rough);
  EXPECT_EQ(finds.all().size(), 1U);
  rough.p_map_m.x() = 1.6;
  rough.sigma_m = 3.0;  // however rough
  finds.note(rough);
  EXPECT_EQ(finds.all().size(), 2U);
}

TEST(OwnDetections, ASightingBelongsToTheNearestFind) {
  OwnDetections finds;
  finds.note(sighting(0.0, 0.0));
  finds.note(sighting(1.5, 0.0));
  finds.note(sighting(0.9, 0.0));
  EXPECT_EQ(finds.all()[0].sightings, 1U);
  EXPECT_EQ(finds.all()[1].sightings, 2U);
}

TEST(OwnDetections, ConfidenceGrowsWithSightingsAndStaysBelowCertainty) {
  OwnDetections finds;
  double before = 0.0;
  for (int i = 0; i < 20; ++i) {
    finds.note(sighting(0.0, 0.0));
    EXPECT_GT(finds.all()[0].confidence, before);
    before = finds.all()[0].confidence;
  }
  EXPECT_NEAR(before, 1.0 - std::pow(0.92, 20), 1e-9);
  for (int i = 0; i < 1000; ++i) finds.note(sighting(0.0, 0.0));
  EXPECT_EQ(finds.all()[0].confidence, OwnDetections::kMostConfidence);
}

TEST(OwnDetections, NumbersThatAreNoneAreLeftOut) {
  OwnDetections finds;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  finds.note(sighting(nan, 0.0));
  finds.note(sighting(0.0, std::numeric_limits<double>::infinity()));
  for (const double sigma_m : {0.0, -1.0, nan}) {
    MapSighting bad = sighting(0.0, 0.0);
    bad.sigma_m = sigma_m;
    finds.note(bad);
  }
  MapSighting unsure = sighting(0.0, 0.0);
  unsure.confidence = nan;
  finds.note(unsure);
  EXPECT_TRUE(finds.all().empty());
}

TEST(OwnDetections, ThereAreNoMoreThanEverybodyKeeps) {
  OwnDetections finds;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 3; ++k) finds.note(sighting(2.0 * i, 0.0));
  }
  EXPECT_EQ(finds.all().size(), OwnDetections::kMost);
  EXPECT_EQ(finds.all().back().p_map_m.x(), 126.0);
  finds.note(sighting(0.0, 0.0));  // known ones are still seen
  EXPECT_EQ(finds.all()[0].sightings, 4U);
}

TEST(OwnDetections, AFloodOfSlipsLeavesRoomForFinds) {
  OwnDetections finds;
  for (int k = 0; k < 3; ++k) finds.note(sighting(-5.0, 0.0));
  for (int i = 0; i < 200; ++i) finds.note(sighting(2.0 * i, 0.0, i));
  EXPECT_EQ(finds.all().size(), OwnDetections::kMost);
  EXPECT_EQ(finds.all()[0].p_map_m.x(), -5.0);
  for (int k = 0; k < 3; ++k) finds.note(sighting(-9.0, 0.0, 300));
  int found = 0;
  for (std::uint32_t i = 0; i < finds.all().size(); ++i) {
    EXPECT_EQ(finds.all()[i].number, i);
    found += finds.all()[i].p_map_m.x() == -9.0 && finds.all()[i].sightings == 3 ? 1 : 0;
  }
  EXPECT_EQ(found, 1);
}

TEST(OwnDetections, AreNamedApartInEveryMap) {
  OwnDetections finds;
  finds.note(sighting(0.0, 0.0));
  finds.note(sighting(5.0, 2.0, 7));
  const auto first = to_wire(finds.all()[1], test::layer("alpha", 1));
  const auto second = to_wire(finds.all()[1], test::layer("alpha", 2, -1));
  EXPECT_NE(first.detection_id, second.detection_id);
  EXPECT_NE(first.detection_id, to_wire(finds.all()[1], test::layer("alpha", 1), 1).detection_id);
  EXPECT_NE(first.detection_id, to_wire(finds.all()[0], test::layer("alpha", 1)).detection_id);
  EXPECT_EQ(second.agent_id, "alpha");
  EXPECT_EQ(second.map_id, 2U);
  EXPECT_EQ(second.floor, -1);
  EXPECT_EQ(second.x_m, 5.0);
  EXPECT_EQ(second.y_m, 2.0);
  EXPECT_EQ(second.revision, 1U);
  EXPECT_EQ(second.first_seen_at_ns, 7'000'000'000);
}

}  // namespace
}  // namespace lifeline::sharing
