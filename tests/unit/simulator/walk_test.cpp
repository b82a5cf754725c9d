#include "agents/sources/simulator/walk.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/office.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

std::vector<Pose2> walked(const FreeSpace& space, const WalkerNumber& number, double seconds,
                          double step_s = 0.1) {
  Walk walk(space, number);
  std::vector<Pose2> poses;
  for (double t = 0.0; t < seconds; t += step_s) poses.push_back(walk.pose_at(t));
  return poses;
}

bool same(const Pose2& a, const Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.yaw_rad == b.yaw_rad;
}

class WalkTest : public ::testing::Test {
 protected:
  FreeSpace space_ = FreeSpace::make(generate_office({}).value()).value();
};

TEST_F(WalkTest, IsTheSameForTheSameNumbers) {
  const auto a = walked(space_, {.seed = 5, .walker = 1, .walkers = 2}, 60.0);
  const auto b = walked(space_, {.seed = 5, .walker = 1, .walkers = 2}, 60.0);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(), same));
}

TEST_F(WalkTest, WalkersBeginElsewhereFacingElsewhere) {
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const Pose2 a = walked(space_, {.seed = 1, .walker = i, .walkers = 1}, 0.05).front();
      const Pose2 b = walked(space_, {.seed = 1, .walker = j, .walkers = 1}, 0.05).front();
      EXPECT_GT((a.translation() - b.translation()).norm(), 4.0);
      EXPECT_GT(std::abs(normalise_angle(a.yaw_rad - b.yaw_rad)), 0.01);
    }
  }
}

TEST_F(WalkTest, DoesNotDependOnHowOftenItIsAskedFor) {
  const auto often = walked(space_, {}, 30.0, 0.025);
  const auto seldom = walked(space_, {}, 30.0, 0.1);
  for (std::size_t i = 0; i < seldom.size(); i += 7) {
    EXPECT_NEAR((often[4 * i].translation() - seldom[i].translation()).norm(), 0.0, 1e-6);
    EXPECT_NEAR(normalise_angle(often[4 * i].yaw_rad - seldom[i].yaw_rad), 0.0, 1e-6);
  }
}

TEST_F(WalkTest, GetsAboutAtAPersonsPace) {
  const auto poses = walked(space_, {}, 120.0);
  double length_m = 0.0, fastest = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double step_m = (poses[i].translation() - poses[i - 1].translation()).norm();
    length_m += step_m;
    fastest = std::max(fastest, step_m / 0.1);
  }
  EXPECT_GT(length_m / 120.0, 0.6);
  EXPECT_GT(fastest, 0.95);
}

TEST_F(WalkTest, LooksWhereItGoesMostOfTheTime) {
  const auto poses = walked(space_, {}, 120.0);
  int moving = 0, facing = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector2d step = poses[i].translation() - poses[i - 1].translation();
    if (step.norm() < 0.05) continue;
    ++moving;
    const double off = normalise_angle(std::atan2(step.y(), step.x()) - poses[i].yaw_rad);
    facing += std::abs(off) < 0.7;
  }
  EXPECT_GT(facing, 9 * moving / 10);
}

TEST_F(WalkTest, TheHeadSwaysOnAStraightWay) {
  const FreeSpace hall = FreeSpace::make(support::room(60.0, 1.6)).value();
  Walk walk(hall, {});
  std::vector<double> yaws;
  for (double t = 15.0; t < 40.0; t += 0.1) yaws.push_back(std::abs(walk.pose_at(t).yaw_rad));
  const auto [least, most] = std::minmax_element(yaws.begin(), yaws.end());
  EXPECT_GT(*most - *least, 0.05);
}

TEST_F(WalkTest, SaysWhenItsFirstRoundIsDoneAndGoesOn) {
  const FreeSpace rooms = FreeSpace::make(support::two_rooms(0.9)).value();
  Walk walk(rooms, {});
  double t = 0.0;
  Pose2 pose = walk.pose_at(t);
  EXPECT_FALSE(walk.first_round_done());
  for (; t < 120.0 && !walk.first_round_done(); t += 0.1) pose = walk.pose_at(t);
  ASSERT_TRUE(walk.first_round_done());
  double farthest = 0.0;
  for (const double end = t + 20.0; t < end; t += 0.1) {
    farthest = std::max(farthest, (walk.pose_at(t).translation() - pose.translation()).norm());
  }
  EXPECT_GT(farthest, 1.0);
}

TEST_F(WalkTest, InARoomSeenAtAGlanceItStandsAndLooks) {
  const FreeSpace cell = FreeSpace::make(support::room(1.8, 1.8)).value();
  Walk walk(cell, {});
  const Pose2 first = walk.pose_at(0.0);
  const Pose2 later = walk.pose_at(30.0);
  EXPECT_LT((first.translation() - later.translation()).norm(), 1.5);
  EXPECT_TRUE(later.is_finite());
  EXPECT_TRUE(walk.first_round_done());
}

}  // namespace
}  // namespace lifeline::sources
