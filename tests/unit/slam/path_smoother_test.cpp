#include "agents/slam/path_smoother.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace lifeline::slam {
namespace {

constexpr int kScans = 60, kFirstBlind = 20, kLastBlind = 27;
constexpr double kStep_s = 0.1, kSigma_m = 0.007;

Timestamp stamp(int scan) {
  return Timestamp(from_seconds(1000.0 + kStep_s * scan));
}

PositionFix seen(double along_sigma_m, double across_sigma_m) {
  PositionFix fix;
  fix.information.diagonal() << 1.0 / (along_sigma_m * along_sigma_m),
      1.0 / (across_sigma_m * across_sigma_m);
  return fix;
}

/// Along x at 1 m/s; at scan 20 the walker brakes to a stand within a second.
double true_x_m(int scan) {
  const double t_s = kStep_s * (scan - kFirstBlind);
  if (t_s <= 0.0) return t_s;
  const double braking_s = std::min(t_s, 1.0);
  return braking_s - 0.5 * braking_s * braking_s;
}

/// Scans `kFirstBlind` to `kLastBlind` see nothing along x: the helmet goes on as fast as before.
std::vector<PathPlace> blind_while_braking() {
  std::vector<PathPlace> path;
  for (int scan = 0; scan < kScans; ++scan) {
    const bool blind = scan >= kFirstBlind && scan <= kLastBlind;
    const double x_m = blind ? kStep_s * (scan - kFirstBlind) : true_x_m(scan);
    PositionFix fix = seen(kSigma_m, kSigma_m);
    if (blind) fix.information(0, 0) = 0.0;
    path.push_back({stamp(scan), {x_m, 0.0}, fix});
  }
  return path;
}

TEST(PathSmoother, ABlindStretchLiesWhereTheScansBeforeAndAfterSay) {
  const auto path = blind_while_braking();
  const auto smoothed = smooth_path(path);
  ASSERT_EQ(smoothed.size(), path.size());
  double before_m = 0.0, after_m = 0.0;
  for (int scan = kFirstBlind; scan <= kLastBlind; ++scan) {
    const auto i = static_cast<std::size_t>(scan);
    before_m = std::max(before_m, std::abs(path[i].p_map_m.x() - true_x_m(scan)));
    after_m = std::max(after_m, std::abs(smoothed[i].x() - true_x_m(scan)));
    EXPECT_NEAR(smoothed[i].y(), 0.0, 1e-6);
  }
  EXPECT_GT(before_m, 0.2);
  EXPECT_LT(after_m, 0.03);
}

TEST(PathSmoother, ScansThatSeeWellStayWithinTheirError) {
  const auto path = blind_while_braking();
  const auto smoothed = smooth_path(path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].fix.information(0, 0) == 0.0) continue;
    EXPECT_LT((smoothed[i] - path[i].p_map_m).norm(), kSigma_m) << i;
  }
}

TEST(PathSmoother, APlaceThatIsCertainStays) {
  auto path = blind_while_braking();
  for (PathPlace& place : path) place.fix = certain_fix();
  path[30].p_map_m.x() += 0.1;
  const auto smoothed = smooth_path(path);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LT((smoothed[i] - path[i].p_map_m).norm(), 0.001) << i;
}

TEST(PathSmoother, NothingIsSmoothedAcrossAJump) {
  auto path = blind_while_braking();
  for (std::size_t i = 40; i < path.size(); ++i) path[i].p_map_m.y() += 3.0;
  const auto smoothed = smooth_path(path);
  for (std::size_t i = 30; i < 50; ++i) EXPECT_NEAR(smoothed[i].y(), i < 40 ? 0.0 : 3.0, 1e-6) << i;
}

TEST(PathSmoother, NothingIsSmoothedAcrossAPause) {
  auto path = blind_while_braking();
  const auto whole = smooth_path(path);
  for (std::size_t i = 24; i < path.size(); ++i) path[i].stamp += std::chrono::seconds(2);
  const auto smoothed = smooth_path(path);
  // With nothing after the pause to tell, the blind scans before it stay where they were put.
  EXPECT_NEAR(smoothed[23].x(), path[23].p_map_m.x(), 0.02);
  EXPECT_GT(smoothed[23].x(), whole[23].x() + 0.02);
}

TEST(PathSmoother, StampsThatGoBackOrRepeatBeginAnew) {
  auto path = blind_while_braking();
  path[10].stamp = path[9].stamp;
  path[12].stamp = path[2].stamp;
  for (const Eigen::Vector2d& p : smooth_path(path)) EXPECT_TRUE(p.allFinite());
}

TEST(PathSmoother, AnEmptyPathStaysEmpty) {
  EXPECT_TRUE(smooth_path({}).empty());
}

TEST(PositionFix, IsWhatTheScanSaidBeforeThePredictionDrewIt) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    const Prediction prediction{{uniform(random), uniform(random), 0.0}, 0.025, 0.01};
    const Eigen::Rotation2Dd axes(std::numbers::pi * uniform(random));
    const Eigen::Vector2d sigmas_m(0.005 + 0.02 * uniform(random), 0.005 + 0.3 * uniform(random));
    const Eigen::Matrix2d information =
        axes * Eigen::Vector2d(sigmas_m.array().square().inverse()).asDiagonal() * axes.inverse();
    const Eigen::Vector2d alone(uniform(random), uniform(random));
    const double prior = 1.0 / (0.025 * 0.025);
    const Eigen::Matrix2d together = information + prior * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d placed =
        together.inverse() * (information * alone + prior * prediction.T_map_head.translation());
    MatchResult match;
    match.verdict = Verdict::accepted;
    match.T_map_head = {placed.x(), placed.y(), 0.0};
    match.evidence.covariance.topLeftCorner<2, 2>() = together.inverse();
    const PositionFix fix = position_fix(match, prediction);
    EXPECT_LT((fix.information - information).norm(), 1e-6 * information.norm());
    EXPECT_LT((placed + fix.information.inverse() * fix.pull - alone).norm(), 1e-6);
  }
}

TEST(PositionFix, ARejectedMatchTellsNothing) {
  MatchResult match;
  match.verdict = Verdict::rejected;
  match.evidence.covariance.setIdentity();
  EXPECT_EQ(position_fix(match, {{}, 0.02, 0.01}).information.norm(), 0.0);
}

TEST(PositionFix, AMatchThatStatesNoCovarianceStaysWhereItIs) {
  MatchResult match;
  match.verdict = Verdict::accepted;
  EXPECT_EQ(position_fix(match, {{}, 0.02, 0.01}).information, certain_fix().information);
}

}  // namespace
}  // namespace lifeline::slam
