#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "agents/helmet_mapper.hpp"
#include "tests/unit/slam/walked_wing.hpp"

namespace lifeline {
namespace {

using slam::kTenthSecond;
using Spoil = std::function<void(sensing::RawScan&)>;

constexpr int kFirst = 120;  ///< bad scan
constexpr int kScans = 220;

/// What the sensors give at place k of the way.
sensing::RawScan raw_scan(const support::FlatWorld& world, const slam::Way& way, int k) {
  sensing::RawScan raw;
  raw.stamp = Timestamp(kTenthSecond * k);
  raw.first_angle_rad = -M_PI;
  raw.angle_step_rad = M_PI / 180.0;
  raw.range_min_m = 0.1;
  raw.range_max_m = 12.0;
  raw.attitude = sensing::Attitude{0.0, 0.0, way.at(k).yaw_rad};
  std::mt19937 random(static_cast<unsigned>(k));
  std::normal_distribution<double> noise(0.0, 0.01);
  for (int i = 0; i < 360; ++i) {
    const double angle_rad = way.at(k).yaw_rad + raw.first_angle_rad + i * raw.angle_step_rad;
    raw.ranges_m.push_back(
        static_cast<float>(world.range(way.at(k).translation(), angle_rad) + noise(random)));
  }
  return raw;
}

/// A walk whose scans kFirst ... kFirst + count - 1 are spoilt.
struct Outcome {
  int lowest_trust = 100;  ///< from the first bad scan until ten after the last
  int last_trust = 0;
  double worst_m = 0.0;      ///< of all scans that were used
  bool map_changed = false;  ///< by the bad scans
};
Outcome play(int count, const Spoil& spoil) {
  const support::FlatWorld world = slam::wing();
  const slam::Way way = slam::through_the_wing();
  HelmetMapper mapper({}, kGeometry, {});
  Outcome outcome;
  TsdGrid before;
  for (int k = 0; k < kScans; ++k) {
    sensing::RawScan raw = raw_scan(world, way, k);
    const bool is_bad = k >= kFirst && k < kFirst + count;
    if (k == kFirst) before = slam::copy_of(mapper.layer());
    if (is_bad) spoil(raw);
    mapper.step(raw);
    if (k == kFirst + count - 1) outcome.map_changed = !slam::same_cells(before, mapper.layer());
    const sharing::HelmetState state = mapper.state();
    EXPECT_TRUE(state.T_map_head.is_finite());
    if (k >= kFirst && k < kFirst + count + 10) {
      outcome.lowest_trust = std::min(outcome.lowest_trust, int{state.trust_percent});
    }
    outcome.last_trust = state.trust_percent;
    if (state.state != wire::AgentState::tracking || is_bad) continue;
    const Pose2 truth = way.at(0).inverse() * way.at(k);
    outcome.worst_m =
        std::max(outcome.worst_m, (truth.translation() - state.T_map_head.translation()).norm());
  }
  return outcome;
}

void expect_no_harm(const Outcome& outcome) {
  EXPECT_LT(outcome.lowest_trust, 100);
  EXPECT_EQ(outcome.last_trust, 100);
  EXPECT_LT(outcome.worst_m, play(0, [](sensing::RawScan&) {}).worst_m + 0.02);
}

TEST(BadScans, AllInvalidLowersTrustAndLeavesTheMap) {
  const Outcome outcome =
      play(10, [](sensing::RawScan& raw) { raw.ranges_m.assign(raw.ranges_m.size(), 0.0F); });
  EXPECT_EQ(outcome.lowest_trust, 0);
  EXPECT_FALSE(outcome.map_changed);
  expect_no_harm(outcome);
}

TEST(BadScans, FourFifthsInvalidLowersTrust) {
  expect_no_harm(play(10, [](sensing::RawScan& raw) {
    for (std::size_t i = 0; i < raw.ranges_m.size(); ++i) {
      if (i % 5 != 0) raw.ranges_m[i] = 0.0F;
    }
  }));
}

TEST(BadScans, OneBeamLowersTrustAndLeavesTheMap) {
  const Outcome outcome = play(10, [](sensing::RawScan& raw) { raw.ranges_m.resize(1); });
  EXPECT_FALSE(outcome.map_changed);
  expect_no_harm(outcome);
}

TEST(BadScans, NaNLowersTrustAndLeavesTheMap) {
  const Outcome outcome = play(10, [](sensing::RawScan& raw) {
    raw.ranges_m.assign(raw.ranges_m.size(), std::numeric_limits<float>::quiet_NaN());
  });
  EXPECT_FALSE(outcome.map_changed);
  expect_no_harm(outcome);
}

TEST(BadScans, InfinityEverywhereLowersTrustAndCarvesNothing) {
  const Outcome outcome = play(10, [](sensing::RawScan& raw) {
    raw.ranges_m.assign(raw.ranges_m.size(), std::numeric_limits<float>::infinity());
  });
  EXPECT_FALSE(outcome.map_changed);
  expect_no_harm(outcome);
}

TEST(BadScans, AFrozenSweepIsNotUsedOnceTheHeadTurned) {
  std::vector<float> frozen;
  const Outcome outcome = play(15, [&](sensing::RawScan& raw) {
    if (frozen.empty()) frozen = raw.ranges_m;
    raw.ranges_m = frozen;
  });
  EXPECT_LE(outcome.lowest_trust, 40);
  expect_no_harm(outcome);
}

TEST(BadScans, TimeThatGoesBackLowersTrust) {
  expect_no_harm(play(1, [](sensing::RawScan& raw) { raw.stamp -= std::chrono::seconds(2); }));
}

TEST(BadScans, ABeamCountThatChangesLowersTrust) {
  expect_no_harm(play(1, [](sensing::RawScan& raw) {
    std::vector<float> half;
    for (std::size_t i = 0; i < raw.ranges_m.size(); i += 2) half.push_back(raw.ranges_m[i]);
    raw.ranges_m = half;
    raw.angle_step_rad *= 2.0;
  }));
}

slam::ScanFaults check_of(const sensing::RawScan& raw, double turn_rad, int repeats) {
  slam::ScanCheck check;
  sensing::SensedMotion motion;
  motion.elapsed = kTenthSecond;
  motion.yaw_step_rad = turn_rad;
  slam::ScanFaults faults;
  for (int i = 0; i < repeats; ++i) faults = check.next(raw, motion);
  return faults;
}

TEST(ScanCheck, AHeadThatStandsStillMaySeeTheSameForEver) {
  const sensing::RawScan raw = raw_scan(slam::wing(), slam::through_the_wing(), 0);
  EXPECT_FALSE(check_of(raw, 0.0, 100).any());
  EXPECT_FALSE(check_of(raw, 0.004, 2).any());
  EXPECT_TRUE(check_of(raw, 0.02, 5).frozen);
}

TEST(ScanCheck, ASweepOfNoReadingsIsSparseNotFrozen) {
  sensing::RawScan raw = raw_scan(slam::wing(), slam::through_the_wing(), 0);
  slam::ScanCheck check;
  (void)check.next(raw, {});
  raw.ranges_m.assign(360, 0.0F);
  sensing::SensedMotion motion{kTenthSecond, {}, 0.1};
  EXPECT_TRUE(check.next(raw, motion).sparse);
  EXPECT_FALSE(check.next(raw, motion).frozen);
}

TEST(ScanCheck, AFrozenSweepWithGapsIsFrozenAllTheSame) {
  sensing::RawScan raw = raw_scan(slam::wing(), slam::through_the_wing(), 0);
  raw.ranges_m[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(check_of(raw, 0.03, 10).frozen);
}

}  // namespace
}  // namespace lifeline
