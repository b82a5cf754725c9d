// Which of its finds a helmet tells the others, and what it makes of theirs.

#include <cmath>

#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::sharing {
namespace {

/// A state whose only find was seen `sightings` times, last at (x, 0).
HelmetState with_find(std::uint32_t sightings, double x_m) {
  HelmetState state;
  state.state = wire::AgentState::tracking;
  state.detections.push_back({.number = 0,
                              .p_map_m = {x_m, 0.0},
                              .confidence = 0.6,
                              .first_seen = Timestamp(std::chrono::seconds(5)),
                              .seen = Timestamp(std::chrono::seconds(9)),
                              .sightings = sightings});
  return state;
}

TEST_F(HelmetSharingTest, AFindIsToldAtOnceAndItsNewsOnceASecond) {
  auto alpha = make_helmet("alpha");
  const auto heard = bus_.reader<wire::Detection>();
  std::vector<wire::Detection> samples;
  for (std::uint32_t i = 1; i <= 60; ++i) {  // three seconds, seen at each step
    alpha->put(with_find(i, 2.0 + 0.001 * i));
    run({alpha.get()}, milliseconds(50));
    for (auto& sample : heard->take()) samples.push_back(std::move(sample));
  }
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0].revision, 3U);  // seen less often, it could be a slip
  EXPECT_EQ(samples[0].agent_id, "alpha");
  EXPECT_EQ(samples[0].first_seen_at_ns, 5'000'000'000);
  EXPECT_EQ(samples[0].seen_at_ns, 9'000'000'000);
  EXPECT_GT(samples[1].revision, samples[0].revision);
  run({alpha.get()}, milliseconds(5000));  // the last news come, and then none
  const auto rest = heard->take();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].revision, 60U);
}

TEST_F(HelmetSharingTest, FindsOfAllStandInEverybodysListAlsoALateJoiners) {
  auto alpha = make_helmet("alpha"), bravo = make_helmet("bravo");
  alpha->put(with_find(3, 2.0));
  bravo->put(with_find(4, 1.1));
  direct(1, {{"alpha", {}}, {"bravo", {1.0, 0.0, 0.0}}});
  run({alpha.get(), bravo.get()});
  auto charlie = make_helmet("charlie");
  run({alpha.get(), bravo.get(), charlie.get()});
  const auto list = alpha->detections();
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].seen_by, (std::vector<std::string>{"alpha", "bravo"}));
  EXPECT_NEAR(list[0].x_m, 2.05, 1e-5);
  EXPECT_EQ(bravo->detections(), list);
  EXPECT_EQ(charlie->detections(), list);
}

TEST_F(HelmetSharingTest, FindsThatAreHostileOrOfAnotherMissionAreRefusedAndCounted) {
  auto alpha = make_helmet("alpha");
  const auto stranger = bus_.writer<wire::Detection>();
  auto sample = test::detection(layer("bravo"), 1, std::nan(""), 0.0);
  ASSERT_TRUE(stranger->put(sample));
  sample = test::detection(layer("bravo"), 2, 0.0, 0.0);
  sample.envelope.mission_id = "another";
  ASSERT_TRUE(stranger->put(sample));
  run({alpha.get()});
  EXPECT_EQ(alpha->refused(), 2U);
  EXPECT_TRUE(alpha->detections().empty());
}

TEST_F(HelmetSharingTest, ARulingOnItsOwnFindReachesItsFinder) {
  auto alpha = make_helmet("alpha");
  const auto heard = bus_.reader<wire::Detection>();
  const auto commander = bus_.writer<wire::Detection>();
  alpha->put(with_find(3, 2.0));
  run({alpha.get()});
  auto ruling = heard->take().at(0);
  ruling.envelope.sender_id = "vehicle";
  ruling.revision = 1;
  ruling.state = wire::DetectionState::dismissed;
  ASSERT_TRUE(commander->put(ruling));
  run({alpha.get()});
  ASSERT_EQ(alpha->detections().size(), 1U);
  EXPECT_EQ(alpha->detections()[0].state, wire::DetectionState::dismissed);
}

}  // namespace
}  // namespace lifeline::sharing
