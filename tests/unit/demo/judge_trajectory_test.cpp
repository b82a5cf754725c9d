#include "deploy/demo/judge_trajectory.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/files/tum.hpp"

namespace lifeline::demo {
namespace {

class JudgeTrajectory : public testing::Test {
 protected:
  JudgeTrajectory() : folder_(testing::TempDir() + "judge_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~JudgeTrajectory() override { std::filesystem::remove_all(folder_); }

  TrajectoryVerdict judge(const std::vector<StampedPose>& estimate,
                          const std::vector<StampedPose>& truth) {
    EXPECT_TRUE(files::write_tum(folder_ / "a.tum", estimate));
    EXPECT_TRUE(files::write_tum(folder_ / "a.truth.tum", truth));
    return judge_trajectory(folder_ / "a.tum", folder_ / "a.truth.tum");
  }

  std::filesystem::path folder_;
};

/// A walk with a bend, a pose every 3 s: farther apart than anybody would interpolate.
std::vector<StampedPose> walk() {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 20; ++i) {
    const double bend = i < 10 ? 0.0 : 0.4 * (i - 10);
    poses.push_back({Timestamp(from_seconds(1000.25 + 3.0 * i)), {0.5 * i, bend, 0.03 * i}});
  }
  return poses;
}

std::vector<StampedPose> seen_from(const Pose2& T_world_map, std::vector<StampedPose> poses) {
  for (StampedPose& pose : poses) pose.pose = T_world_map * pose.pose;
  return poses;
}

TEST_F(JudgeTrajectory, of_a_perfect_one_gives_no_error_and_where_the_map_lies) {
  const TrajectoryVerdict verdict = judge(walk(), seen_from({7.0, -3.0, 2.0}, walk()));
  ASSERT_TRUE(verdict.rmse_m);
  EXPECT_NEAR(*verdict.rmse_m, 0.0, 1e-5);
  ASSERT_TRUE(verdict.T_world_map);
  EXPECT_NEAR(verdict.T_world_map->x_m, 7.0, 1e-5);
  EXPECT_NEAR(verdict.T_world_map->y_m, -3.0, 1e-5);
  EXPECT_NEAR(verdict.T_world_map->yaw_rad, 2.0, 1e-5);
}

TEST_F(JudgeTrajectory, sees_where_it_went_wrong) {
  std::vector<StampedPose> off = walk();
  for (std::size_t i = 10; i < off.size(); ++i) off[i].pose.y_m += 1.0;
  const TrajectoryVerdict verdict = judge(off, walk());
  ASSERT_TRUE(verdict.rmse_m);
  EXPECT_GT(*verdict.rmse_m, 0.1);
}

TEST_F(JudgeTrajectory, does_without_a_truth_for_every_pose) {
  std::vector<StampedPose> truth = seen_from({1.0, 2.0, 0.0}, walk());
  truth.erase(truth.begin(), truth.begin() + 3);
  const TrajectoryVerdict verdict = judge(walk(), truth);
  ASSERT_TRUE(verdict.T_world_map);
  EXPECT_NEAR(verdict.T_world_map->x_m, 1.0, 1e-5);
}

TEST_F(JudgeTrajectory, does_not_hang_the_map_s_place_on_one_bad_pose) {
  std::vector<StampedPose> truth = walk();
  truth.front().pose.yaw_rad += 0.2;
  const TrajectoryVerdict verdict = judge(walk(), truth);
  ASSERT_TRUE(verdict.T_world_map);
  EXPECT_LT(std::abs(verdict.T_world_map->yaw_rad), 0.01);
}

TEST_F(JudgeTrajectory, bears_a_truth_whose_times_go_back) {
  std::vector<StampedPose> truth = walk();
  std::swap(truth[4], truth[5]);
  EXPECT_TRUE(judge(walk(), truth).rmse_m);
}

TEST_F(JudgeTrajectory, stays_silent_without_a_truth) {
  ASSERT_TRUE(files::write_tum(folder_ / "b.tum", walk()));
  const TrajectoryVerdict verdict = judge_trajectory(folder_ / "b.tum", folder_ / "b.truth.tum");
  EXPECT_FALSE(verdict.rmse_m);
  EXPECT_FALSE(verdict.T_world_map);
}

TEST_F(JudgeTrajectory, stays_silent_on_files_that_hold_no_poses) {
  std::ofstream(folder_ / "c.tum") << "no poses at all\n";
  EXPECT_FALSE(judge_trajectory(folder_ / "c.tum", folder_ / "c.tum").rmse_m);
}

}  // namespace
}  // namespace lifeline::demo
