#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "agents/sensing/motion_tracker.hpp"
#include "agents/slam/deskew.hpp"
#include "agents/slam/motion_model.hpp"
#include "tests/support/flat_world.hpp"

namespace lifeline::slam {
namespace {

using sensing::Attitude;
using sensing::MotionTracker;
using sensing::RawScan;

constexpr Duration kScanTime = std::chrono::milliseconds(100);

RawScan at(int tenths) {
  RawScan raw;
  raw.stamp = Timestamp(kScanTime * tenths);
  return raw;
}

TEST(MotionTracker, KnowsNothingAtTheFirstScan) {
  MotionTracker tracker;
  RawScan first = at(5);
  first.T_odom_head = Pose2{1.0, 2.0, 3.0};
  first.attitude = Attitude{0.0, 0.0, 1.0};
  const auto motion = tracker.next(first);
  EXPECT_EQ(motion.elapsed, Duration{0});
  EXPECT_FALSE(motion.T_previous_now);
  EXPECT_FALSE(motion.yaw_step_rad);
}

TEST(MotionTracker, GivesDifferencesInTheFormerHeadsFrame) {
  MotionTracker tracker;
  RawScan raw = at(0);
  raw.T_odom_head = Pose2{1.0, 2.0, M_PI / 2.0};
  raw.attitude = Attitude{0.0, 0.0, 3.1};
  (void)tracker.next(raw);
  raw = at(1);
  raw.T_odom_head = Pose2{1.0, 2.5, M_PI / 2.0 + 0.1};
  raw.attitude = Attitude{0.0, 0.0, -3.1};
  const auto motion = tracker.next(raw);
  EXPECT_EQ(motion.elapsed, kScanTime);
  ASSERT_TRUE(motion.T_previous_now);
  EXPECT_NEAR(motion.T_previous_now->x_m, 0.5, 1e-12);
  EXPECT_NEAR(motion.T_previous_now->y_m, 0.0, 1e-12);
  EXPECT_NEAR(motion.T_previous_now->yaw_rad, 0.1, 1e-12);
  ASSERT_TRUE(motion.yaw_step_rad);
  EXPECT_NEAR(*motion.yaw_step_rad, 2.0 * M_PI - 6.2, 1e-12);  // the short way around
}

TEST(MotionTracker, TakesValuesThatAreNotFiniteForMissing) {
  MotionTracker tracker;
  RawScan raw = at(0);
  raw.T_odom_head = Pose2{};
  raw.attitude = Attitude{};
  (void)tracker.next(raw);
  raw = at(1);
  raw.T_odom_head = Pose2{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  raw.attitude = Attitude{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()};
  const auto motion = tracker.next(raw);
  EXPECT_FALSE(motion.T_previous_now);
  EXPECT_FALSE(motion.yaw_step_rad);
}

TEST(MotionTracker, AGapInTheOdometryIsNotBridged) {
  MotionTracker tracker;
  RawScan raw = at(0);
  raw.T_odom_head = Pose2{};
  (void)tracker.next(raw);
  (void)tracker.next(at(1));
  raw = at(2);
  raw.T_odom_head = Pose2{5.0, 0.0, 0.0};
  EXPECT_FALSE(tracker.next(raw).T_previous_now);
}

MotionPrior after(Duration elapsed) {
  MotionPrior prior;
  prior.elapsed = elapsed;
  return prior;
}

/// After a second at 0.1 m and 0.05 rad a scan.
MotionModel walked() {
  MotionModel model({});
  model.reset({});
  for (int i = 1; i <= 10; ++i) model.matched({0.1 * i, 0.0, 0.05 * i}, after(kScanTime));
  return model;
}

TEST(MotionModel, GoesOnAsTheLastScansDidScaledByTime) {
  const Pose2 step = walked().predicted_step(after(2 * kScanTime));
  EXPECT_NEAR(step.translation().norm(), 0.2, 1e-3);
  EXPECT_NEAR(step.yaw_rad, 0.1, 1e-12);
}

TEST(MotionModel, TakesTheYawStepFromTheAttitudeSensorAsEquation5Does) {
  const MotionModel model = walked();
  MotionPrior prior = after(kScanTime);
  prior.yaw_step_rad = -0.3;
  const Pose2 step = model.predicted_step(prior);
  EXPECT_NEAR(step.translation().norm(), 0.1, 1e-3);
  EXPECT_DOUBLE_EQ(step.yaw_rad, -0.3);
  EXPECT_NEAR(model.predict(prior).T_map_head.x_m, 1.1, 1e-3);
}

TEST(MotionModel, OdometryOutranksTheLastStep) {
  MotionModel model({});
  model.reset({});
  model.matched({0.1, 0.0, 0.0}, after(kScanTime));
  MotionPrior prior = after(kScanTime);
  prior.T_previous_now = Pose2{0.5, 0.1, 0.2};
  const Prediction prediction = model.predict(prior);
  EXPECT_NEAR(prediction.T_map_head.x_m, 0.6, 1e-12);
  EXPECT_NEAR(prediction.T_map_head.yaw_rad, 0.2, 1e-12);
}

TEST(MotionModel, LessIsKnownAfterLongerTimes) {
  MotionModel model({});
  model.reset({});
  const Prediction soon = model.predict(after(kScanTime));
  const Prediction late = model.predict(after(3 * kScanTime));
  const Prediction never = model.predict(after(Duration{0}));
  EXPECT_LT(soon.largest_sigma_m(), late.largest_sigma_m());
  EXPECT_LE(late.largest_sigma_m(), never.largest_sigma_m());
  EXPECT_LT(soon.sigma_yaw_rad, late.sigma_yaw_rad);
}

TEST(MotionModel, AScanHardOnTheHeelsOfAnotherMayBeAsFarAwayAsUsual) {
  MotionModel model({});
  model.reset({});
  for (int i = 0; i < 20; ++i) model.matched({}, after(4 * kScanTime));
  const double usual_m = model.predict(after(4 * kScanTime)).largest_sigma_m();
  EXPECT_GT(model.predict(after(kScanTime / 20)).largest_sigma_m(), 0.8 * usual_m);
}

TEST(MotionModel, UncertaintyGrowsWhileLostAndEndsWithAMatch) {
  MotionModel model({});
  model.reset({});
  double before_m = 0.0;
  for (int i = 0; i < 5; ++i) {
    const Prediction prediction = model.predict(after(kScanTime));
    EXPECT_GT(prediction.largest_sigma_m(), before_m);
    before_m = prediction.largest_sigma_m();
    model.lost(prediction, after(kScanTime));
  }
  model.matched(model.pose(), after(kScanTime));
  EXPECT_LT(model.predict(after(kScanTime)).largest_sigma_m(), before_m);
}

TEST(Deskew, BringsASweepTakenInMotionBackToTheFirstBeam) {
  // The head walks 0.15 m and turns 0.2 rad during a sweep of 0.1 s, in a known room.
  const support::FlatWorld world = support::small_flat();
  const support::Lidar lidar;
  const Pose2 motion{0.15, 0.03, 0.2};
  Scan2 swept;
  swept.sweep_time = kScanTime;
  swept.full_circle = true;
  for (std::size_t i = 0; i < lidar.beams; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(lidar.beams - 1);
    const Pose2 T{share * motion.x_m, share * motion.y_m, share * motion.yaw_rad};
    const double angle = lidar.first_angle_rad + static_cast<double>(i) * lidar.step_rad;
    swept.beams.push_back(
        support::hit_beam(angle, world.range(T.translation(), T.yaw_rad + angle)));
  }
  double worst_before = 0.0, worst_after = 0.0;
  for (const Beam2& beam : swept.beams) {
    worst_before = std::max(worst_before, world.distance({beam.x_m, beam.y_m}));
  }
  deskew(swept, motion, kScanTime);
  for (const Beam2& beam : swept.beams) {
    worst_after = std::max(worst_after, world.distance({beam.x_m, beam.y_m}));
    EXPECT_NEAR(beam.range_m, std::hypot(beam.x_m, beam.y_m), 1e-5);
    EXPECT_NEAR(beam.angle_rad, std::atan2(beam.y_m, beam.x_m), 1e-5);
  }
  EXPECT_GT(worst_before, 0.2);
  EXPECT_LT(worst_after, 1e-4);
}

TEST(Deskew, LeavesTheTurnToTheAttitudeThatUndidIt) {
  Scan2 scan = support::scan_of(support::small_flat(), {});
  scan.sweep_time = kScanTime;
  scan.turn_undone = true;
  const Scan2 before = scan;
  deskew(scan, {0.1, 0.0, 0.5}, kScanTime);
  const std::size_t last = scan.beams.size() - 1;
  EXPECT_NEAR(scan.beams[last].x_m, before.beams[last].x_m + 0.1F, 1e-5);
  EXPECT_NEAR(scan.beams[last].y_m, before.beams[last].y_m, 1e-5);
}

TEST(Deskew, LeavesScansAloneThatTookNoTimeOrCannotBeTrue) {
  const Scan2 scan = support::scan_of(support::small_flat(), {});
  Scan2 same = scan;
  deskew(same, {0.1, 0.0, 0.1}, kScanTime);  // no sweep time
  EXPECT_EQ(same.beams[10].x_m, scan.beams[10].x_m);
  same.sweep_time = kScanTime;
  deskew(same, {0.1, 0.0, 0.1}, Duration{0});
  deskew(same, {0.1, 0.0, 0.1}, -kScanTime);
  deskew(same, {100.0, 0.0, 0.1}, kScanTime);
  deskew(same, {0.1, 0.0, std::numeric_limits<double>::quiet_NaN()}, kScanTime);
  EXPECT_EQ(same.beams[10].x_m, scan.beams[10].x_m);
}

}  // namespace
}  // namespace lifeline::slam
