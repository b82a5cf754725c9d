#include "agents/sources/simulator/head_motion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/walk.hpp"
#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

TEST(HeadMotion, KeepsItsLimits) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeadMotion motion(seed);
    double before_rad = motion.at(0.0, 1.0).yaw_rad;
    for (double t = 0.01; t < 120.0; t += 0.01) {
      const auto lean = motion.at(t, 1.0);
      EXPECT_LE(std::abs(lean.pitch_rad), HeadMotion::kMostPitchDeg * kDegree);
      EXPECT_LE(std::abs(lean.roll_rad), HeadMotion::kMostRollDeg * kDegree);
      EXPECT_LE(std::abs(lean.yaw_rad), HeadMotion::kMostYawDeg * kDegree);
      EXPECT_LE(std::abs(lean.yaw_rad - before_rad), 0.01 * HeadMotion::kMostYawRateDegS * kDegree);
      before_rad = lean.yaw_rad;
    }
  }
}

TEST(HeadMotion, ANoddingHeadReachesItsLimitsAndKeepsThem) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeadMotion motion(seed, HeadMotion::Style::nodding);
    double most_pitch_rad = 0.0, most_roll_rad = 0.0;
    for (double t = 0.0; t < 120.0; t += 0.01) {
      const auto lean = motion.at(t, 1.0);
      most_pitch_rad = std::max(most_pitch_rad, std::abs(lean.pitch_rad));
      most_roll_rad = std::max(most_roll_rad, std::abs(lean.roll_rad));
      EXPECT_EQ(lean.yaw_rad, 0.0);
    }
    EXPECT_LE(most_pitch_rad, HeadMotion::kNoddingPitchDeg * kDegree + 1e-12);
    EXPECT_LE(most_roll_rad, HeadMotion::kNoddingRollDeg * kDegree + 1e-12);
    EXPECT_GT(most_pitch_rad, (HeadMotion::kNoddingPitchDeg - 0.5) * kDegree);
    EXPECT_GT(most_roll_rad, (HeadMotion::kNoddingRollDeg - 0.5) * kDegree);
  }
}

TEST(HeadMotion, StepsShakeOnlySomeoneWhoWalks) {
  // What is quicker than a second: the second difference over a quarter of a second.
  const HeadMotion motion(7);
  const auto shaken = [&](double pace) {
    double sum = 0.0;
    for (double t = 1.0; t < 30.0; t += 0.01) {
      const auto pitch = [&](double at) { return motion.at(at, pace).pitch_rad; };
      sum += std::abs(pitch(t - 0.25) - 2.0 * pitch(t) + pitch(t + 0.25));
    }
    return sum;
  };
  EXPECT_GT(shaken(1.0), 4.0 * shaken(0.0));
}

TEST(HeadMotion, NodsTwiceASecondWhileWalking) {
  const HeadMotion motion(7);
  int turns = 0;
  double last = 0.0;
  for (double t = 0.0; t < 30.0; t += 0.01) {
    const double nod = motion.at(t, 1.0).pitch_rad - motion.at(t, 0.0).pitch_rad;
    turns += nod * last < 0.0 ? 1 : 0;
    last = nod;
  }
  EXPECT_NEAR(turns / 2.0 / 30.0, 2.0, 0.15);
}

TEST(HeadMotion, LooksUpAndDownByMoreThanEightDegreesInAll) {
  const HeadMotion motion(3);
  double lowest = 1.0, highest = -1.0;
  for (double t = 0.0; t < 60.0; t += 0.1) {
    lowest = std::min(lowest, motion.at(t, 1.0).pitch_rad);
    highest = std::max(highest, motion.at(t, 1.0).pitch_rad);
  }
  EXPECT_GT(highest - lowest, 8.0 * kDegree);
}

TEST(HeadMotion, AnotherSeedMovesOtherwise) {
  EXPECT_EQ(HeadMotion(1).at(3.0, 1.0).pitch_rad, HeadMotion(1).at(3.0, 1.0).pitch_rad);
  EXPECT_NE(HeadMotion(1).at(3.0, 1.0).pitch_rad, HeadMotion(2).at(3.0, 1.0).pitch_rad);
}

TEST(Walk, TheWayIsTheSameHoweverTheHeadIsHeld) {
  const auto space = FreeSpace::make(generate_office({}).value()).value();
  Walk still(space, {}), natural(space, {}, Walk::Head::natural);
  double turned = 0.0, leant = 0.0, fastest = 0.0;
  Pose2 before = natural.pose_at(0.0);
  for (double t = 0.05; t < 60.0; t += 0.05) {
    const HeadPose a = still.head_at(t), b = natural.head_at(t);
    EXPECT_EQ(a.T_world_head.x_m, b.T_world_head.x_m);
    EXPECT_EQ(a.T_world_head.y_m, b.T_world_head.y_m);
    EXPECT_EQ(a.roll_rad, 0.0);
    EXPECT_EQ(a.pitch_rad, 0.0);
    turned = std::max(turned,
                      std::abs(normalise_angle(a.T_world_head.yaw_rad - b.T_world_head.yaw_rad)));
    leant = std::max(leant, std::abs(b.pitch_rad));
    fastest = std::max(fastest,
                       std::abs(normalise_angle(b.T_world_head.yaw_rad - before.yaw_rad)) / 0.05);
    before = b.T_world_head;
  }
  EXPECT_GT(turned, 8.0 * kDegree);
  EXPECT_GT(leant, 5.0 * kDegree);
  EXPECT_LE(fastest, WalkLimits::kNaturalTurnRadS);
}

}  // namespace
}  // namespace lifeline::sources
