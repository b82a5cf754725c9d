#include "common/sharing/detection_list.hpp"

#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using test::detection;
using test::layer;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A directive that lays layers into groups: {layer, group, T_common_map}.
struct Member {
  LayerKey key;
  std::uint16_t group;
  Pose2 T_common_map;
};
wire::MergeDirective directive(const std::vector<Member>& members) {
  wire::MergeDirective directive;
  for (const Member& each : members) {
    wire::DirectiveMember member;
    member.layer = {each.key.agent_id.text(), each.key.map_id.value, each.key.floor.value};
    member.group = each.group;
    member.T_common_map = to_fixed(each.T_common_map);
    directive.members.push_back(member);
  }
  return directive;
}

class DetectionListTest : public ::testing::Test {
 protected:
  void put(const wire::Detection& sample) { ASSERT_TRUE(list_.apply(sample)); }
  std::string refusal(const wire::Detection& sample) {
    const auto applied = list_.apply(sample);
    return applied ? "accepted" : applied.error().text;
  }

  const LayerKey alpha_ = layer("alpha"), bravo_ = layer("bravo");
  /// Bravo's map lies 10 m ahead of alpha's, turned by a right angle.
  const wire::MergeDirective merged_ =
      directive({{alpha_, 0, {}}, {bravo_, 0, {10.0, 0.0, std::numbers::pi / 2.0}}});
  DetectionList list_;
};

TEST_F(DetectionListTest, WhatTwoHelmetsSawIsOneEntryOnceTheirMapsAreMerged) {
  put(detection(alpha_, 256, 10.0, 3.0, 20, 25));
  put(detection(bravo_, 256, 3.2, 0.0, 12, 40));  // alpha would say (10, 3.2)
  ASSERT_EQ(list_.list().size(), 2U);
  list_.follow(merged_);
  const auto all = list_.list();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].group, std::uint16_t{0});
  EXPECT_NEAR(all[0].x_m, 10.0, 1e-5);
  EXPECT_NEAR(all[0].y_m, 3.1, 1e-5);
  EXPECT_DOUBLE_EQ(all[0].confidence, 0.75);
  EXPECT_EQ(all[0].first, (Sighted{12'000'000'000, "bravo"}));
  EXPECT_EQ(all[0].last, (Sighted{40'000'000'000, "bravo"}));
  EXPECT_THAT(all[0].seen_by, ElementsAre("alpha", "bravo"));
}

TEST_F(DetectionListTest, AWithdrawnDirectiveLeavesNoTrace) {
  put(detection(alpha_, 256, 10.0, 3.0));
  put(detection(bravo_, 256, 3.0, 0.0));
  const auto before = list_.list();
  list_.follow(merged_);
  EXPECT_EQ(list_.list().size(), 1U);
  list_.follow(directive({}));
  EXPECT_EQ(list_.list(), before);
  EXPECT_EQ(before[0].group, std::nullopt);
  EXPECT_EQ(before[0].layer, alpha_);
}

TEST_F(DetectionListTest, GroupsFloorsAndKindsAreKeptApart) {
  const LayerKey above = layer("bravo", 1, 1);
  put(detection(alpha_, 256, 1.0, 1.0));
  put(detection(bravo_, 256, 1.0, 1.0));
  put(detection(above, 512, 1.0, 1.0));
  auto tag = detection(layer("charlie"), 256, 1.0, 1.0);
  tag.kind = wire::DetectionKind::uwb_tag;
  put(tag);
  list_.follow(
      directive({{alpha_, 0, {}}, {above, 0, {}}, {layer("charlie"), 0, {}}, {bravo_, 1, {}}}));
  EXPECT_EQ(list_.list().size(), 4U);
}

TEST_F(DetectionListTest, TwoFindsOfOneHelmetStayTwoWhateverAnotherSaw) {
  put(detection(alpha_, 256, 0.0, 0.0));
  put(detection(alpha_, 257, 0.9, 0.0));
  put(detection(bravo_, 256, 0.5, 0.0));
  list_.follow(directive({{alpha_, 0, {}}, {bravo_, 0, {}}}));
  const auto all = list_.list();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_THAT(all[0].seen_by, ElementsAre("alpha"));
  EXPECT_THAT(all[1].seen_by, ElementsAre("alpha", "bravo"));  // the nearer one
}

TEST_F(DetectionListTest, ARowOfVictimsIsNotOneLongVictim) {
  put(detection(layer("a"), 256, 0.0, 0.0));
  put(detection(layer("b"), 256, 0.8, 0.0));
  put(detection(layer("c"), 256, 1.7, 0.0));
  list_.follow(directive({{layer("a"), 0, {}}, {layer("b"), 0, {}}, {layer("c"), 0, {}}}));
  EXPECT_EQ(list_.list().size(), 2U);
}

TEST_F(DetectionListTest, AHelmetThatWasRestartedAddsToItsOwnFind) {
  const LayerKey again = layer("alpha", 2);
  put(detection(alpha_, 256, 1.0, 1.0, 5, 9));
  put(detection(again, 512, 1.1, 1.0, 50, 60));
  list_.follow(directive({{alpha_, 0, {}}, {again, 0, {}}}));
  const auto all = list_.list();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all[0].seen_by, ElementsAre("alpha"));
  EXPECT_EQ(all[0].last.at_ns, 60'000'000'000);
}

TEST_F(DetectionListTest, TheStateIsTheFarthestThatAnybodyReports) {
  using wire::DetectionState;
  list_.follow(directive({{alpha_, 0, {}}, {bravo_, 0, {}}}));
  auto a = detection(alpha_, 256, 0.0, 0.0), b = detection(bravo_, 256, 0.1, 0.0);
  const auto together = [&](DetectionState state_a, DetectionState state_b) {
    a.state = state_a;
    b.state = state_b;
    ++a.revision;
    ++b.revision;
    put(a);
    put(b);
    return list_.list().at(0).state;
  };
  EXPECT_EQ(together(DetectionState::dismissed, DetectionState::dismissed),
            DetectionState::dismissed);
  EXPECT_EQ(together(DetectionState::reported, DetectionState::dismissed),
            DetectionState::reported);
  EXPECT_EQ(together(DetectionState::confirmed, DetectionState::reported),
            DetectionState::confirmed);
  EXPECT_EQ(together(DetectionState::dismissed, DetectionState::rescued), DetectionState::rescued);
}

TEST_F(DetectionListTest, OlderRevisionsAndRepeatsChangeNothing) {
  auto sample = detection(alpha_, 256, 1.0, 1.0);
  sample.revision = 5;
  EXPECT_TRUE(list_.apply(sample).value());
  EXPECT_FALSE(list_.apply(sample).value());
  auto old = detection(alpha_, 256, 9.0, 9.0);
  old.revision = 4;
  EXPECT_FALSE(list_.apply(old).value());
  EXPECT_EQ(list_.list().at(0).x_m, 1.0);
}

TEST_F(DetectionListTest, ARulingStandsWhateverTheHelmetSaysLater) {
  auto seen = detection(alpha_, 256, 1.0, 1.0);
  put(seen);
  auto ruling = seen;
  ruling.envelope.sender_id = "vehicle";
  ruling.state = wire::DetectionState::dismissed;
  ruling.x_m = 5.0;
  put(ruling);
  EXPECT_EQ(list_.list().at(0).state, wire::DetectionState::dismissed);
  EXPECT_EQ(list_.list().at(0).x_m, 1.0) << "where it is, its own helmet says";
  seen.revision = 2;
  seen.x_m = 1.5;
  put(seen);
  EXPECT_EQ(list_.list().at(0).state, wire::DetectionState::dismissed);
  EXPECT_EQ(list_.list().at(0).x_m, 1.5);
  EXPECT_FALSE(list_.apply(ruling).value()) << "a repeat";
  ruling.revision = 2;
  ruling.state = wire::DetectionState::reported;
  put(ruling);
  EXPECT_EQ(list_.list().at(0).state, wire::DetectionState::reported);
}

TEST_F(DetectionListTest, ARulingStandsForADetectionThatWasMissed) {
  auto ruling = detection(alpha_, 256, 1.0, 1.0);
  ruling.envelope.sender_id = "vehicle";
  ruling.state = wire::DetectionState::confirmed;
  put(ruling);
  ASSERT_EQ(list_.list().size(), 1U);
  EXPECT_EQ(list_.list().at(0).state, wire::DetectionState::confirmed);
  EXPECT_THAT(list_.list().at(0).made_of, ElementsAre(DetectionKey("alpha", 256)));
  put(detection(alpha_, 256, 2.0, 1.0));
  EXPECT_EQ(list_.list().at(0).x_m, 2.0);
}

TEST_F(DetectionListTest, WhatIsHostileIsRefusedAndNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto good = detection(alpha_, 256, 1.0, 1.0);
  auto bad = good;
  for (const double x_m : {nan, 2000.1, -1e300}) {
    bad = good;
    bad.x_m = x_m;
    EXPECT_THAT(refusal(bad), HasSubstr("detection alpha/256: place"));
  }
  for (const float confidence : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
    bad = good;
    bad.confidence = confidence;
    EXPECT_THAT(refusal(bad), HasSubstr("out of bounds"));
  }
  bad = good;
  bad.kind = static_cast<wire::DetectionKind>(3);
  EXPECT_THAT(refusal(bad), HasSubstr("no such kind"));
  bad = good;
  bad.state = static_cast<wire::DetectionState>(4);
  EXPECT_THAT(refusal(bad), HasSubstr("no such kind or state"));
  bad = good;
  bad.first_seen_at_ns = bad.seen_at_ns + 1;
  EXPECT_THAT(refusal(bad), HasSubstr("seen before it was first seen"));
  bad = good;
  bad.agent_id = "no name";
  EXPECT_NE(refusal(bad), "accepted");
  EXPECT_TRUE(list_.held().empty());
}

TEST_F(DetectionListTest, AFloodOfOneHelmetLeavesRoomForTheOthers) {
  for (std::uint32_t i = 0; i < 500; ++i) (void)list_.apply(detection(alpha_, 500 - i, 3.0 * i, 0));
  EXPECT_EQ(list_.held().size(), DetectionList::kMostPerHelmet);
  EXPECT_EQ(list_.held().rbegin()->first.second, DetectionList::kMostPerHelmet);  // the lowest ids
  put(detection(bravo_, 1, 0.0, 0.0));
  EXPECT_THAT(refusal(detection(alpha_, 65, 0.0, 0.0)), HasSubstr("alpha/65: more than 64"));
}

}  // namespace
}  // namespace lifeline::sharing
