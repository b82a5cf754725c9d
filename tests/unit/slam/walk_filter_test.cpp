#include "agents/slam/walk_filter.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "agents/slam/motion_model.hpp"

namespace lifeline::slam {
namespace {

constexpr double kStep_s = 0.1, kSigma_m = 0.006, kSpeed_m_s = 1.2;
const WalkFilter kFilter(1.5);

PositionFix seen_everywhere() {
  PositionFix fix;
  fix.information.diagonal().setConstant(1.0 / (kSigma_m * kSigma_m));
  return fix;
}

PositionFix seen_across_x() {
  PositionFix fix = seen_everywhere();
  fix.information(0, 0) = 0.0;
  return fix;
}

/// After two seconds at kSpeed_m_s along x, ending at the origin.
WalkState walking() {
  WalkState state = WalkFilter::begin({-2.0 * kSpeed_m_s, 0.0}, kSigma_m, 0.5);
  for (int i = 19; i >= 0; --i) {
    state = kFilter.after(state, kStep_s, kStep_s);
    state = WalkFilter::take_in(state, {-kStep_s * kSpeed_m_s * i, 0.0}, seen_everywhere());
  }
  return state;
}

/// A second along a corridor in which scans see nothing along x: each lies where it was expected.
WalkState blind_for_a_second(WalkState state) {
  for (int i = 0; i < 10; ++i) {
    state = kFilter.after(state, kStep_s, kStep_s);
    state = WalkFilter::take_in(state, {state.position_m().x(), 0.0}, seen_across_x());
  }
  return state;
}

TEST(WalkFilter, GoesOnAtTheSpeedKnownBeforeWhereScansSeeNothing) {
  const WalkState blind = blind_for_a_second(walking());
  EXPECT_NEAR(blind.position_m().x(), kSpeed_m_s, 0.02);
  EXPECT_NEAR(blind.position_m().y(), 0.0, 1e-6);
  const Eigen::Matrix2d unsure = blind.position_covariance(0.0);
  EXPECT_GT(std::sqrt(unsure(0, 0)), 0.1);
  EXPECT_LT(std::sqrt(unsure(1, 1)), kSigma_m);
}

TEST(WalkFilter, WhatABlindSecondGotWrongIsNotTakenForTheLastStep) {
  // He had slowed down: the first scan that sees is 0.3 m behind where it was expected.
  WalkState state = blind_for_a_second(walking());
  state = kFilter.after(state, kStep_s, kStep_s);
  const double behind_m = 0.3;
  state = WalkFilter::take_in(state, {state.position_m().x() - behind_m, 0.0}, seen_everywhere());
  EXPECT_GT(state.mean[2], kSpeed_m_s - 3.0 * behind_m);
  EXPECT_LT(state.mean[2], kSpeed_m_s - 0.5 * behind_m);
}

/// Speeds' error, root of the mean square, of a walker whose sweeps are set straight with the
/// filter's own velocity: where that is wrong, the scan lies off by half a sweep's error.
double speed_error_m_s(bool knows_of_sweeps, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise_m(0.0, kSigma_m), push_m_s2(0.0, 1.5);
  const double half_sweep_s = 0.5 * kStep_s;
  const WalkFilter filter(2.5);
  WalkState state = WalkFilter::begin({0.0, 0.0}, kSigma_m, 0.5);
  double x_m = 0.0, speed_m_s = 0.0, sum = 0.0;
  constexpr int kScans = 400;
  for (int i = 0; i < kScans; ++i) {
    const double push = push_m_s2(random);
    x_m += kStep_s * speed_m_s + 0.5 * push * kStep_s * kStep_s;
    speed_m_s += push * kStep_s;
    state = filter.after(state, kStep_s, kStep_s);
    const double used_m_s = state.mean[2];
    PositionFix fix = seen_everywhere();
    if (knows_of_sweeps) {
      fix.after_stamp_s = half_sweep_s;
      fix.ahead_m = {half_sweep_s * used_m_s, 0.0};
    }
    const double placed_m = x_m + half_sweep_s * (speed_m_s - used_m_s) + noise_m(random);
    state = WalkFilter::take_in(state, {placed_m, 0.0}, fix);
    sum += (state.mean[2] - speed_m_s) * (state.mean[2] - speed_m_s);
  }
  return std::sqrt(sum / kScans);
}

TEST(WalkFilter, ASweepSetStraightWithAWrongVelocityTellsOfItsMiddle) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    EXPECT_LT(speed_error_m_s(true, seed), 0.7 * speed_error_m_s(false, seed)) << seed;
  }
}

TEST(MotionModel, AHeadThatTurnsGoesOnTheWayItsWearerWalks) {
  MotionModel model({});
  model.reset({});
  MotionPrior prior;
  prior.elapsed = from_seconds(kStep_s);
  for (int i = 1; i <= 20; ++i) {
    prior.yaw_step_rad = 0.1;
    model.matched({kStep_s * kSpeed_m_s * i, 0.0, 0.1 * i}, prior, seen_everywhere());
  }
  const Pose2 next = model.predict(prior).T_map_head;
  EXPECT_NEAR(next.x_m, kStep_s * kSpeed_m_s * 21, 0.005);
  EXPECT_NEAR(next.y_m, 0.0, 0.005);
  EXPECT_NEAR(next.yaw_rad, 2.1, 1e-9);
}

TEST(MotionModel, ACorrectedMapTurnsTheWalkAlong) {
  MotionModel model({});
  model.reset({});
  MotionPrior prior;
  prior.elapsed = from_seconds(kStep_s);
  for (int i = 1; i <= 20; ++i)
    model.matched({kStep_s * kSpeed_m_s * i, 0.0, 0.0}, prior, seen_everywhere());
  const Pose2 before = model.predict(prior).T_map_head;
  const Pose2 T_new_old{1.0, -2.0, 0.7};
  model.move(T_new_old);
  const Pose2 expected = T_new_old * before, after = model.predict(prior).T_map_head;
  EXPECT_NEAR(after.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(after.y_m, expected.y_m, 1e-9);
}

}  // namespace
}  // namespace lifeline::slam
