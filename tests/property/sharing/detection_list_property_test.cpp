// The fleet's list is the same for everybody, whatever came in what order and how often.

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "common/sharing/detection_list.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using test::detection;
using test::layer;

/// A mission: what its helmets sent, and where their maps lie.
struct Mission {
  std::vector<wire::Detection> samples;
  wire::MergeDirective directive;
};

/// `helmets` that saw some of the victims within 15 m, each by a map frame of its own, several
/// revisions of each find.
Mission make_mission(std::mt19937& random, int helmets, int victims) {
  std::uniform_real_distribution<double> place(-15.0, 15.0), angle(-3.0, 3.0);
  std::normal_distribution<double> error(0.0, 0.15);
  std::vector<Eigen::Vector2d> there;
  for (int i = 0; i < victims; ++i) there.emplace_back(place(random), place(random));
  Mission mission;
  for (int h = 0; h < helmets; ++h) {
    const LayerKey key = layer("helmet" + std::to_string(h));
    const Pose2 T_common_map{place(random), place(random), angle(random)};
    if (random() % 5 != 0) {  // some are in no group
      wire::DirectiveMember member;
      member.layer = {key.agent_id.text(), 1, 0};
      member.group = static_cast<std::uint16_t>(random() % 4 == 0 ? 1 : 0);
      member.T_common_map = to_fixed(T_common_map);
      mission.directive.members.push_back(member);
    }
    for (std::uint32_t v = 0; v < there.size(); ++v) {
      if (random() % 3 == 0) continue;
      for (std::uint32_t revision = 1; revision <= 1 + random() % 4; ++revision) {
        const Eigen::Vector2d p_map =
            T_common_map.inverse() * (there[v] + Eigen::Vector2d(error(random), error(random)));
        auto sample = detection(key, 256 + v, p_map.x(), p_map.y(), 5,
                                6 + static_cast<std::int64_t>(random() % 50));
        sample.revision = revision;
        sample.confidence = static_cast<float>(random() % 1000) / 1000.0F;
        sample.state = static_cast<wire::DetectionState>(random() % 4);
        mission.samples.push_back(sample);
      }
    }
  }
  return mission;
}

class FleetList : public ::testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
};

TEST_P(FleetList, DoesNotDependOnOrderRepeatsOrWhenTheDirectiveCame) {
  const Mission mission = make_mission(random_, 8, 12);
  DetectionList reference;
  reference.follow(mission.directive);
  for (const auto& sample : mission.samples) ASSERT_TRUE(reference.apply(sample));
  const auto expected = reference.list();
  ASSERT_FALSE(expected.empty());
  for (int run = 0; run < 10; ++run) {
    auto samples = mission.samples;
    samples.insert(samples.end(), mission.samples.begin(),
                   mission.samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2));
    std::shuffle(samples.begin(), samples.end(), random_);
    DetectionList list;
    const std::size_t directive_at = random_() % (samples.size() + 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i == directive_at) list.follow(mission.directive);
      ASSERT_TRUE(list.apply(samples[i]));
    }
    if (directive_at == samples.size()) list.follow(mission.directive);
    EXPECT_EQ(list.list(), expected);
  }
}

TEST_P(FleetList, AWrongDirectiveLeavesNoTraceOnceItIsCorrectedOrWithdrawn) {
  const Mission mission = make_mission(random_, 6, 10);
  DetectionList list;
  for (const auto& sample : mission.samples) ASSERT_TRUE(list.apply(sample));
  const auto alone = list.list();
  list.follow(mission.directive);
  const auto merged = list.list();
  list.follow(make_mission(random_, 6, 1).directive);
  list.follow(mission.directive);
  EXPECT_EQ(list.list(), merged);
  list.follow({});
  EXPECT_EQ(list.list(), alone);
  EXPECT_LE(merged.size(), alone.size());
}

TEST_P(FleetList, KeepsEveryDetectionInExactlyOneEntryThatLiesNearIt) {
  const Mission mission = make_mission(random_, 8, 12);
  DetectionList list;
  list.follow(mission.directive);
  for (const auto& sample : mission.samples) ASSERT_TRUE(list.apply(sample));
  std::size_t seen_by = 0;
  for (const FleetDetection& entry : list.list()) {
    seen_by += entry.seen_by.size();
    EXPECT_LE(entry.first, entry.last);
    EXPECT_GE(entry.confidence, 0.0);
    EXPECT_LE(entry.confidence, 1.0);
    EXPECT_TRUE(std::is_sorted(entry.seen_by.begin(), entry.seen_by.end()));
  }
  EXPECT_EQ(seen_by, list.held().size());  // one map each: an entry holds a helmet once
}

TEST_P(FleetList, KeepsTheSameOfAFloodInAnyOrder) {
  std::vector<wire::Detection> samples;
  for (int h = 0; h < 40; ++h) {
    for (std::uint32_t i = 0; i < 80; ++i) {
      samples.push_back(detection(layer("helmet" + std::to_string(h)),
                                  static_cast<std::uint32_t>(1 + random_() % 200),
                                  static_cast<double>(i), static_cast<double>(h)));
      samples.back().revision = static_cast<std::uint32_t>(1 + random_() % 3);
    }
  }
  DetectionList reference;
  for (const auto& sample : samples) (void)reference.apply(sample);
  EXPECT_EQ(reference.held().size(), DetectionList::kMost);
  std::shuffle(samples.begin(), samples.end(), random_);
  DetectionList list;
  for (const auto& sample : samples) (void)list.apply(sample);
  const auto keys_of = [](const DetectionList& of) {
    std::vector<std::tuple<DetectionKey, std::uint32_t, double>> keys;
    for (const auto& [key, held] : of.held()) keys.emplace_back(key, held.revision, held.x_m);
    return keys;
  };
  EXPECT_EQ(keys_of(list), keys_of(reference));
}

INSTANTIATE_TEST_SUITE_P(Seeds, FleetList, ::testing::Range(1U, 21U));

}  // namespace
}  // namespace lifeline::sharing
