#include "agents/sources/simulator/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/angles.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

constexpr double kPi = std::numbers::pi;

const FloorPlan& square() {
  static const FloorPlan plan = support::room(10.0, 10.0);
  return plan;
}

sensing::RawScan sweep(const LidarOptions& options, const Pose2& pose, std::uint64_t seed = 1) {
  SimulatedLidar lidar(options, seed);
  return lidar.sweep(
      RayScene(square().walls), [&](double) { return pose; }, 0.0);
}

/// Four beams: behind, right, ahead, left.
constexpr LidarOptions kPerfect{.beams = 4, .noise_m = 0.0, .dropout_share = 0.0};

TEST(SimulatedLidar, MeasuresWhatIsThere) {
  const auto scan = sweep(kPerfect, {3.0, 4.0, 0.0});

  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_FLOAT_EQ(scan.ranges_m[0], 3.0F);
  EXPECT_FLOAT_EQ(scan.ranges_m[1], 4.0F);
  EXPECT_FLOAT_EQ(scan.ranges_m[2], 7.0F);
  EXPECT_FLOAT_EQ(scan.ranges_m[3], 6.0F);
  EXPECT_DOUBLE_EQ(scan.first_angle_rad, -kPi);
  EXPECT_DOUBLE_EQ(scan.angle_step_rad, 0.5 * kPi);
}

TEST(SimulatedLidar, TurnsWithTheHead) {
  const auto scan = sweep(kPerfect, {3.0, 4.0, 0.5 * kPi});

  EXPECT_FLOAT_EQ(scan.ranges_m[2], 6.0F);  // ahead is y now
  EXPECT_FLOAT_EQ(scan.ranges_m[3], 3.0F);
}

TEST(SimulatedLidar, BeamsEndOnTheWallsUnderTheScansOwnGeometry) {
  LidarOptions options = kPerfect;
  options.beams = 360;
  const Pose2 pose{3.0, 4.0, 0.7};
  const auto scan = sweep(options, pose);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle = scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i);
    const Eigen::Vector2d p_world = pose * Eigen::Vector2d(scan.ranges_m[i] * std::cos(angle),
                                                           scan.ranges_m[i] * std::sin(angle));
    double off = 1.0;
    for (const auto& wall : square().walls) off = std::min(off, distance_to(wall, p_world));
    EXPECT_LT(off, 0.001);
  }
}

TEST(SimulatedLidar, ALeaningBeamEndsAtWallFloorOrCeilingWhicheverIsNearest) {
  SimulatedLidar lidar(kPerfect, 1);
  const auto ranges_m = [&](double roll, double pitch) {
    const HeadPose head({5.0, 5.0, 0.0}, roll, pitch);
    return lidar
        .sweep(
            RayScene(square().walls), [&](double) { return head; }, 0.0)
        .ranges_m;
  };
  // 10 deg nose down: the walls ahead and behind are met at 5 m / cos.
  const auto slight = ranges_m(0.0, 10.0 * kDegree);
  EXPECT_NEAR(slight[2], 5.0 / std::cos(10.0 * kDegree), 1e-3);
  EXPECT_NEAR(slight[0], 5.0 / std::cos(10.0 * kDegree), 1e-3);
  EXPECT_NEAR(slight[1], 5.0, 1e-3);
  // 30 deg: ahead the floor 1.7 m below comes first, behind the ceiling 1 m above.
  const auto steep = ranges_m(0.0, 30.0 * kDegree);
  EXPECT_NEAR(steep[2], 1.7 / std::sin(30.0 * kDegree), 1e-3);
  EXPECT_NEAR(steep[0], 1.0 / std::sin(30.0 * kDegree), 1e-3);
  // Leaning to the right (about x forward, positive): right goes down, left goes up.
  const auto leant = ranges_m(30.0 * kDegree, 0.0);
  EXPECT_NEAR(leant[1], 1.7 / std::sin(30.0 * kDegree), 1e-3);
  EXPECT_NEAR(leant[3], 1.0 / std::sin(30.0 * kDegree), 1e-3);
}

TEST(SimulatedLidar, CarriesTheTruth) {
  const auto scan = sweep(kPerfect, {3.0, 4.0, 0.7});
  ASSERT_TRUE(scan.T_world_head_truth.has_value());
  EXPECT_EQ(scan.T_world_head_truth->x_m, 3.0);
  EXPECT_EQ(scan.T_world_head_truth->yaw_rad, 0.7);
}

TEST(SimulatedLidar, NothingWithinRangeIsInfinityAndTooCloseIsNoReading) {
  LidarOptions options = kPerfect;
  options.range_max_m = 5.0;
  const auto scan = sweep(options, {9.9, 4.0, 0.0});

  EXPECT_EQ(scan.ranges_m[0], std::numeric_limits<float>::infinity());
  EXPECT_FLOAT_EQ(scan.ranges_m[1], 4.0F);
  EXPECT_EQ(scan.ranges_m[2], 0.0F);
  EXPECT_EQ(scan.ranges_m[3], std::numeric_limits<float>::infinity());
}

TEST(SimulatedLidar, RangesAreWholeMillimetres) {
  LidarOptions options;
  options.dropout_share = 0.0;
  for (const float range : sweep(options, {3.0, 4.0, 0.7}).ranges_m) {
    const double millimetres = 1000.0 * static_cast<double>(range);
    EXPECT_NEAR(millimetres, std::round(millimetres), 1e-2);
  }
}

TEST(SimulatedLidar, NoiseGrowsWithRangeAsStated) {
  for (const double range : {1.0, 9.0}) {
    LidarOptions options{.beams = 4, .noise_m = 0.01, .dropout_share = 0.0};
    SimulatedLidar lidar(options, 3);
    const RayScene scene(square().walls);
    double sum = 0.0, squares = 0.0;
    constexpr int kSweeps = 4000;
    for (int i = 0; i < kSweeps; ++i) {
      const auto scan = lidar.sweep(
          scene,
          [&](double) {
            return Pose2{10.0 - range, 5.0, 0.0};
          },
          0.0);
      const double error = static_cast<double>(scan.ranges_m[2]) - range;
      sum += error;
      squares += error * error;
    }
    const double sigma_m = 0.01 + 0.001 * range;
    EXPECT_NEAR(sum / kSweeps, 0.0, 0.1 * sigma_m);
    EXPECT_NEAR(std::sqrt(squares / kSweeps), sigma_m, 0.05 * sigma_m);
  }
}

TEST(SimulatedLidar, OneReadingInAHundredIsMissing) {
  std::size_t missing = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto scan = sweep({}, {5.0, 5.0, 0.0}, seed);
    missing +=
        static_cast<std::size_t>(std::count(scan.ranges_m.begin(), scan.ranges_m.end(), 0.0F));
    all += scan.ranges_m.size();
  }
  EXPECT_EQ(all, 20U * 1600U);
  EXPECT_NEAR(static_cast<double>(missing) / static_cast<double>(all), 0.01, 0.003);
}

TEST(SimulatedLidar, AllBeamsAtOnceTakeNoTime) {
  int asked = 0;
  SimulatedLidar lidar({}, 1);
  const auto scan = lidar.sweep(
      RayScene(square().walls),
      [&](double t_s) {
        ++asked;
        EXPECT_DOUBLE_EQ(t_s, 7.0);
        return Pose2{5.0, 5.0, 0.0};
      },
      7.0);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(scan.sweep_time, Duration::zero());
}

TEST(SimulatedLidar, BeamByBeamEachHasThePoseOfItsTime) {
  LidarOptions options = kPerfect;
  options.takes_time = true;
  SimulatedLidar lidar(options, 1);
  // 4 m/s ahead: 0.1 m from beam to beam.
  const auto scan = lidar.sweep(
      RayScene(square().walls),
      [](double t_s) {
        return Pose2{3.0 + 4.0 * t_s, 4.0, 0.0};
      },
      0.0);

  EXPECT_FLOAT_EQ(scan.ranges_m[0], 3.0F);
  EXPECT_FLOAT_EQ(scan.ranges_m[2], 7.0F - 0.2F);
  EXPECT_NEAR(to_seconds(scan.sweep_time), 0.075, 1e-9);
  EXPECT_DOUBLE_EQ(scan.T_world_head_truth->x_m, 3.0);
}

TEST(SimulatedLidar, IsTheSameForTheSameSeedAlone) {
  const Pose2 pose{3.0, 4.0, 0.7};
  EXPECT_EQ(sweep({}, pose, 4).ranges_m, sweep({}, pose, 4).ranges_m);
  EXPECT_NE(sweep({}, pose, 4).ranges_m, sweep({}, pose, 5).ranges_m);
}

TEST(SimulatedAhrs, IsNoisyByHalfADegreeAboutAZeroOfItsOwn) {
  SimulatedAhrs ahrs(3), other(4);
  const double zero = ahrs.measure(0.0, 0.0).yaw_rad;
  EXPECT_GT(std::abs(normalise_angle(zero - other.measure(0.0, 0.0).yaw_rad)), 0.05);

  double squares = 0.0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const double step =
        normalise_angle(ahrs.measure(1.0, 0.0).yaw_rad - ahrs.measure(1.0, 0.0).yaw_rad);
    squares += step * step;
  }
  EXPECT_NEAR(std::sqrt(squares / kCount) / std::numbers::sqrt2, 0.5 * kDegree, 0.02 * kDegree);
}

TEST(SimulatedAhrs, FollowsTheHead) {
  SimulatedAhrs ahrs(3);
  const double before = ahrs.measure(0.3, 0.0).yaw_rad, after = ahrs.measure(1.5, 0.1).yaw_rad;
  EXPECT_NEAR(normalise_angle(after - before), 1.2, 4.0 * kDegree);
}

TEST(SimulatedAhrs, DriftsWithTheRootOfTime) {
  double squares = 0.0;
  constexpr int kCount = 300;
  for (std::uint64_t seed = 0; seed < kCount; ++seed) {
    SimulatedAhrs ahrs(seed);
    const double before = ahrs.measure(0.0, 0.0).yaw_rad;
    for (int i = 0; i < 100; ++i) (void)ahrs.measure(0.0, 16.0);
    const double drift = normalise_angle(ahrs.measure(0.0, 0.0).yaw_rad - before);
    squares += drift * drift;
  }
  // 1600 s: 40 * 0.05 deg, and twice the white noise.
  EXPECT_NEAR(std::sqrt(squares / kCount), std::hypot(2.0, 0.707) * kDegree, 0.25 * kDegree);
}

TEST(SimulatedAhrs, TheHeadIsHeldUpright) {
  const auto attitude = SimulatedAhrs(1).measure(0.5, 0.1);
  EXPECT_EQ(attitude.roll_rad, 0.0);
  EXPECT_EQ(attitude.pitch_rad, 0.0);
}

}  // namespace
}  // namespace lifeline::sources
