#include "tests/bench/slam/slam_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "tests/bench/slam/body_error.hpp"
#include "tests/bench/slam/slam_judge.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

using ::testing::HasSubstr;

/// Two rounds on a circle of 2 m, looking left and right of the way.
std::vector<StampedPose> circle() {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 200; ++i) {
    const double angle = 4.0 * M_PI * i / 200;
    poses.push_back({Timestamp(std::chrono::milliseconds(100) * i),
                     {2.0 * std::cos(angle), 2.0 * std::sin(angle),
                      normalise_angle(angle + 0.5 * M_PI + 0.4 * std::sin(0.3 * i))}});
  }
  return poses;
}

TEST(BodyError, FindsWhereTheOtherBodySits) {
  const Pose2 T_world_map{3.0, -1.0, 0.7}, T_body_reference{0.05, -0.03, 0.02};
  const auto estimate = circle();
  std::vector<StampedPose> truth;
  for (const auto& pose : estimate) {
    truth.push_back({pose.stamp, T_world_map * pose.pose * T_body_reference});
  }
  const auto fitted = body_error(estimate, truth).value();
  EXPECT_LT(fitted.error.rmse_m, 2e-4);
  EXPECT_NEAR(fitted.T_estimated_reference.x_m, T_body_reference.x_m, 1e-3);
  EXPECT_NEAR(fitted.T_estimated_reference.y_m, T_body_reference.y_m, 1e-3);
  EXPECT_NEAR(fitted.T_estimated_reference.yaw_rad, T_body_reference.yaw_rad, 1e-3);
}

TEST(HeadingDrift, IsTheHeadingGainedForEachMetre) {
  const auto truth = circle();
  auto estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double gained_rad = 0.1 * static_cast<double>(i) / 199.0;
    estimate[i].pose.yaw_rad = normalise_angle(estimate[i].pose.yaw_rad + gained_rad + 1.0);
  }
  // From the first ten poses' mean to the last ten's: 190 of 199 steps, over the whole way.
  const double way_m = 2.0 * 2.0 * std::sin(M_PI / 100.0) * 199.0;
  EXPECT_NEAR(heading_drift_deg_per_m(estimate, truth), 0.1 * 190.0 / 199.0 * 180.0 / M_PI / way_m,
              1e-9);
  EXPECT_EQ(heading_drift_deg_per_m(truth, truth), 0.0);
}

SlamOutcome outcome(double off_at_100_m) {
  SlamOutcome run;
  run.truth = circle();
  run.trajectory = circle();
  run.trajectory[100].pose.x_m += off_at_100_m;
  run.stats = {
      {"step_ms_median", 0.5}, {"step_ms_p99", 0.9}, {"peak_rss_mb", 20.0}, {"failures", 3}};
  return run;
}

TEST(JudgeWalk, APoseThatIsFarOffIsATrackingFailure) {
  EXPECT_TRUE(judge_walk(outcome(0.3))->tracked);
  EXPECT_FALSE(judge_walk(outcome(0.8))->tracked);
  EXPECT_NEAR(judge_walk(outcome(0.8))->worst_m, 0.8, 0.02);
}

TEST(JudgeLog, BarsAreForTheDefaultMatcherAlone) {
  const LogCase log{.name = "log", .source = "carmen:x", .bar = 0.01, .beams = 361};
  const auto misses = [&](const char* matcher) {
    const auto rows = judge_log(log, matcher, outcome(1.0));
    return std::ranges::count_if(rows, [](const ReportRow& row) { return !row.ok(); });
  };
  EXPECT_EQ(misses(kDefaultMatcher), 2);  // accuracy, and 0.5 ms instead of 0.25 ms
  EXPECT_EQ(misses("conventional"), 0);
}

TEST(JudgeLog, AFailedRunIsNeverOk) {
  const LogCase log{.name = "log", .source = "carmen:x"};
  const auto rows = judge_log(log, "advanced", fail(ErrorCode::not_found, "no such file"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_FALSE(rows[0].ok());
  EXPECT_THAT(rows[0].reference, HasSubstr("no such file"));
}

TEST(AccuracyRows, MissWhereARunFailed) {
  const WalkFigures good{.rmse_m = 0.01, .tracked = true};
  EXPECT_TRUE(accuracy_rows("w", {good, good}, true).front().ok());
  EXPECT_FALSE(accuracy_rows("w", {good, std::nullopt}, true).front().ok());
  EXPECT_EQ(tracking_row("w", {good, std::nullopt}, true).value, 50.0);
  EXPECT_FALSE(tracking_row("w", {good, std::nullopt}, true).ok());
  EXPECT_TRUE(tracking_row("w", {good, good}, true).ok());
}

TEST(SpreadPlans, GoesFromTheSmallestToTheLargest) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "floorplans/houseexpo");
  std::string index = "id,rooms\n";
  for (const char* id : {"a", "b", "c", "d", "e"}) {
    index += std::string(id) + ",3\n";
    (void)folder.write(std::string("floorplans/houseexpo/") + id + ".json", "{}");
  }
  (void)folder.write("floorplans/houseexpo/index.csv", index);

  const auto plans = spread_plans(folder.path(), 3);
  ASSERT_EQ(plans.size(), 3U);
  EXPECT_EQ(plans[0].stem(), "a");
  EXPECT_EQ(plans[1].stem(), "c");
  EXPECT_EQ(plans[2].stem(), "e");
  EXPECT_EQ(spread_plans(folder.path(), 20).size(), 5U);
  EXPECT_TRUE(spread_plans(folder.path() / "none", 20).empty());
}

TEST(LogCases, LeaveOutWhatIsNotThere) {
  const support::TemporaryFolder folder;
  EXPECT_TRUE(log_cases(folder.path()).empty());
}

TEST(SlamBench, RefusesWrongUse) {
  const std::array<const char*, 1> unknown{"--fast"};
  EXPECT_EQ(run_slam_bench(unknown), 2);
}

}  // namespace
}  // namespace lifeline::bench
