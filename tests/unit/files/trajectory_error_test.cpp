#include "common/files/trajectory_error.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "common/base/angles.hpp"
#include "common/files/tum.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;
using Trajectory = std::vector<StampedPose>;

/// A walk in circles that grow, ten poses a second.
Trajectory walk(int poses, double first_s = 0.0) {
  Trajectory walked;
  for (int i = 0; i < poses; ++i) {
    const double t = first_s + 0.1 * i, r = 3.0 + 0.05 * t;
    walked.push_back(
        {Timestamp(from_seconds(t)),
         {r * std::cos(0.3 * t), r * std::sin(0.3 * t), normalise_angle(0.3 * t + 1.6)}});
  }
  return walked;
}

Trajectory moved(const Pose2& by, Trajectory trajectory) {
  for (auto& [stamp, pose] : trajectory) pose = by * pose;
  return trajectory;
}

/// Errors of a walk, and a drift of its heading.
Trajectory disturbed(Trajectory trajectory) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  double drift = 0.0;
  for (auto& [stamp, pose] : trajectory) {
    drift += 0.002;
    pose.x_m += 0.05 * noise(random) + drift;
    pose.y_m += 0.05 * noise(random);
    pose.yaw_rad = normalise_angle(pose.yaw_rad + drift + 0.01 * noise(random));
  }
  return trajectory;
}

TEST(TrajectoryError, FramesOfTheirOwnAreNoError) {
  const auto error = trajectory_error(moved({5.0, -7.0, 2.8}, walk(100)), walk(100));
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(error->rmse_rad, 0.0, 1e-9);
  EXPECT_EQ(error->poses, 100U);
}

TEST(TrajectoryError, PosesBetweenTwoTrueOnesAreInterpolated) {
  Trajectory between;
  const Trajectory truth = walk(100);
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    const Pose2 &a = truth[i].pose, &b = truth[i + 1].pose;
    const double turn = normalise_angle(b.yaw_rad - a.yaw_rad);
    between.push_back({truth[i].stamp + (truth[i + 1].stamp - truth[i].stamp) / 4,
                       {0.75 * a.x_m + 0.25 * b.x_m, 0.75 * a.y_m + 0.25 * b.y_m,
                        normalise_angle(a.yaw_rad + 0.25 * turn)}});
  }
  const auto error = trajectory_error(between, truth);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->max_m, 0.0, 1e-6);
  EXPECT_NEAR(error->max_rad, 0.0, 1e-6);
}

TEST(TrajectoryError, PosesWithoutATruthNearInTimeAreLost) {
  Trajectory truth = walk(100);
  truth.erase(truth.begin() + 40, truth.begin() + 60);
  const auto error = trajectory_error(walk(110, -0.5), truth);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->poses, 80U);
  EXPECT_EQ(error->lost, 30U);
}

TEST(TrajectoryError, ADisplacementOfOnePoseIsItsShareOfTheSquares) {
  Trajectory estimate = walk(1000);
  estimate[500].pose.x_m += 1.0;
  const auto error = trajectory_error(estimate, walk(1000));
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->rmse_m, std::sqrt(1.0 / 1000.0), 1e-4);
  EXPECT_NEAR(error->max_m, 1.0, 0.01);
}

TEST(TrajectoryError, TooFewPosesAreNotJudged) {
  const auto error = trajectory_error(walk(20), walk(9));
  ASSERT_FALSE(error);
  EXPECT_THAT(error.error().text, HasSubstr("only 9 of 20 poses have a true pose"));
  EXPECT_FALSE(trajectory_error({}, {}));
}

TEST(TrajectoryError, ATruthOutOfOrderIsRefused) {
  Trajectory truth = walk(20);
  std::swap(truth[3], truth[4]);
  EXPECT_THAT(trajectory_error(walk(20), truth).error().text, HasSubstr("order of time"));
}

TEST(TrajectoryError, AgreesWithTheIndependentEvaluator) {
  const std::filesystem::path tool(LIFELINE_SOURCE_DIR "/../shared/tools/evaluate_trajectory.py");
  if (!std::filesystem::exists(tool)) GTEST_SKIP() << "needs " << tool;
  const support::TemporaryFolder folder;
  const Trajectory truth = walk(300);
  const Trajectory estimate = disturbed(moved({-2.0, 4.0, -2.0}, walk(280, 0.37)));
  ASSERT_TRUE(write_tum(folder.path() / "truth.tum", truth));
  ASSERT_TRUE(write_tum(folder.path() / "estimate.tum", estimate));
  const auto ours = trajectory_error(estimate, truth);
  ASSERT_TRUE(ours);

  const std::string command = "python3 " + tool.string() + " " +
                              (folder.path() / "estimate.tum").string() + " " +
                              (folder.path() / "truth.tum").string() + " --json";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::array<char, 512> output{};
  const std::size_t size = std::fread(output.data(), 1, output.size() - 1, pipe);
  ASSERT_EQ(::pclose(pipe), 0);
  unsigned poses = 0, lost = 0;
  double rmse_m = 0.0, max_m = 0.0, rmse_deg = 0.0, max_deg = 0.0;
  ASSERT_EQ(std::sscanf(std::string(output.data(), size).c_str(),
                        "{\"poses\": %u, \"lost\": %u, \"rmse_m\": %lf, \"max_m\": %lf, "
                        "\"rmse_deg\": %lf, \"max_deg\": %lf}",
                        &poses, &lost, &rmse_m, &max_m, &rmse_deg, &max_deg),
            6)
      << output.data();

  EXPECT_EQ(ours->poses, poses);
  EXPECT_EQ(ours->lost, lost);
  EXPECT_NEAR(ours->rmse_m, rmse_m, 1e-6);
  EXPECT_NEAR(ours->max_m, max_m, 1e-6);
  EXPECT_NEAR(ours->rmse_rad / kDegree, rmse_deg, 1e-4);
  EXPECT_NEAR(ours->max_rad / kDegree, max_deg, 1e-4);
  EXPECT_GT(rmse_m, 0.05);
}

}  // namespace
}  // namespace lifeline::files
