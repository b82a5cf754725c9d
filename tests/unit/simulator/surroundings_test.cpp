#include "agents/sources/simulator/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "agents/sources/simulator/sensors.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr LidarOptions kExact{.beams = 720, .noise_m = 0.0, .dropout_share = 0.0};

const RayScene& square() {
  static const RayScene scene(support::room(10.0, 10.0).walls);
  return scene;
}

/// From the middle of the room, nose along x.
sensing::RawScan look(const Surroundings& around, const LidarOptions& options = kExact) {
  SimulatedLidar lidar(options, 1);
  return lidar.sweep(
      around,
      [](double) {
        return HeadPose(Pose2{5.0, 5.0, 0.0});
      },
      0.0);
}

float at(const sensing::RawScan& scan, double angle_rad) {
  return scan.ranges_m[static_cast<std::size_t>(
      std::lround((angle_rad - scan.first_angle_rad) / scan.angle_step_rad))];
}

/// A pane 2 m ahead, across the whole room.
const std::array<WallSegment, 1> kPane{{{{7.0, 0.0}, {7.0, 10.0}}}};

TEST(Glass, ShowsItselfAtARightAngleAndElsewhereWhatIsBehindOrNothing) {
  const auto scan = look({.walls = square(), .panes = kPane});

  EXPECT_FLOAT_EQ(at(scan, 0.0), 2.0F);
  EXPECT_NEAR(at(scan, 0.1), 2.0 / std::cos(0.1), 2e-3);
  int behind = 0, nothing = 0;
  for (double angle = 0.2; angle < 0.75; angle += scan.angle_step_rad) {
    const float range_m = at(scan, angle);
    const bool is_behind = std::abs(range_m - 5.0 / std::cos(angle)) < 0.03;
    EXPECT_TRUE(is_behind || range_m == 0.0F) << angle << ": " << range_m;
    (is_behind ? behind : nothing) += 1;
  }
  EXPECT_GT(behind, 4 * nothing);
  EXPECT_GT(nothing, 0);
}

TEST(Glass, DoesNotTouchWhatStandsInFrontOfIt) {
  const std::array<WallSegment, 1> wall{{{{6.0, 0.0}, {6.0, 10.0}}}};
  const auto with = look({.walls = square(), .more_walls = wall, .panes = kPane});
  EXPECT_EQ(with.ranges_m, look({.walls = square(), .more_walls = wall}).ranges_m);
}

TEST(Black, GivesNoReadingUnlessSomethingStandsBefore) {
  const std::array<WallSegment, 1> black{{{{10.0, 0.0}, {10.0, 10.0}}}};
  const RayScene black_scene(black);
  const std::array<Eigen::Vector2d, 1> people{{{7.0, 5.0}}};
  const auto scan = look({.walls = square(), .black = &black_scene, .people = people});

  EXPECT_EQ(at(scan, 0.3), 0.0F);
  EXPECT_NEAR(at(scan, 0.0), 2.0 - kPersonRadiusM, 1e-3);
  EXPECT_FLOAT_EQ(at(scan, 0.5 * kPi), 5.0F);
}

TEST(Person, IsRoundAndHidesTheWall) {
  const std::array<Eigen::Vector2d, 1> people{{{7.0, 5.0}}};
  const auto scan = look({.walls = square(), .people = people});
  const double edge_rad = std::asin(kPersonRadiusM / 2.0);

  EXPECT_NEAR(at(scan, 0.0), 2.0 - kPersonRadiusM, 1e-3);
  EXPECT_LT(at(scan, 0.9 * edge_rad), 2.0F);
  EXPECT_GT(at(scan, 1.2 * edge_rad), 4.9F);
  EXPECT_TRUE(std::isinf(ray_to_person({0.0, 0.0}, {-1.0, 0.0}, {2.0, 0.0})));
}

TEST(Smoke, FarWallsVanishAndSomeReadingsAreTheSmokesOwn) {
  LidarOptions smoky = kExact;
  smoky.smoke_sight_m = 3.0;
  const auto clear = look({.walls = square()}), scan = look({.walls = square()}, smoky);
  double true_near = 0.0, near = 0.0, true_far = 0.0, far = 0.0, false_near = 0.0, none = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const bool is_far = clear.ranges_m[i] > 6.0F, is_true = scan.ranges_m[i] == clear.ranges_m[i];
    (is_far ? far : near) += 1.0;
    if (is_true) (is_far ? true_far : true_near) += 1.0;
    if (!is_true && scan.ranges_m[i] > 0.0F) {
      false_near += 1.0;
      EXPECT_LT(scan.ranges_m[i], clear.ranges_m[i]);
    }
    none += scan.ranges_m[i] == 0.0F ? 1.0 : 0.0;
  }
  // exp(-5.3 m / 3 m) = 0.17 and exp(-6.5 m / 3 m) = 0.11; of the rest three in ten come back.
  EXPECT_NEAR(true_near / near, 0.17, 0.04);
  EXPECT_NEAR(true_far / far, 0.11, 0.04);
  const double all = near + far, lost = all - true_near - true_far;
  EXPECT_NEAR(false_near / lost, 0.3, 0.06);
  EXPECT_NEAR(none / lost, 0.7, 0.06);
}

TEST(Ceiling, OfEachRoomEndsTheBeamsOfALeaningHead) {
  const CeilingArea low{Eigen::AlignedBox2d(Eigen::Vector2d(6.0, 0.0), Eigen::Vector2d(10.0, 10.0)),
                        1.9};
  const Ceilings ceilings(2.7, {low});
  SimulatedLidar lidar(kExact, 1);
  const HeadPose nose_up(Pose2{5.0, 5.0, 0.0}, 0.0, -0.3);
  const auto scan = lidar.sweep(
      {.walls = square(), .ceilings = &ceilings}, [&](double) { return nose_up; }, 0.0);

  // It has risen to 2.01 m at x = 6, where the ceiling comes down to 1.9 m.
  EXPECT_NEAR(at(scan, 0.0), 1.0 / std::cos(0.3), 1e-3);
}

}  // namespace
}  // namespace lifeline::sources
