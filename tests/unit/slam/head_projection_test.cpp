#include "agents/sensing/head_projection.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lifeline::sensing {
namespace {

constexpr double kPi = std::numbers::pi;

RawScan raw_scan(std::vector<float> ranges_m, double first_rad, double step_rad) {
  RawScan raw;
  raw.first_angle_rad = first_rad;
  raw.angle_step_rad = step_rad;
  raw.range_min_m = 0.1;
  raw.range_max_m = 25.0;
  raw.ranges_m = std::move(ranges_m);
  return raw;
}

/// Heights at which nothing is ever cut off.
ProjectionConfig tall_building() {
  ProjectionConfig config;
  config.sensor_height_m = 1000.0;
  config.ceiling_height_m = 2000.0;
  return config;
}

TEST(HeadProjection, LevelBeamsKeepTheirRangeAndAngle) {
  const RawScan raw = raw_scan({1.0F, 2.0F, 3.0F}, -0.5, 0.5);
  const Scan2 scan = project_scan(raw, {});
  ASSERT_EQ(scan.beams.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = -0.5 + 0.5 * static_cast<double>(i);
    EXPECT_EQ(scan.beams[i].kind, BeamKind::hit);
    EXPECT_NEAR(scan.beams[i].angle_rad, angle, 1e-6);
    EXPECT_NEAR(scan.beams[i].range_m, raw.ranges_m[i], 1e-6);
    EXPECT_NEAR(scan.beams[i].x_m, raw.ranges_m[i] * std::cos(angle), 1e-6);
    EXPECT_NEAR(scan.beams[i].y_m, raw.ranges_m[i] * std::sin(angle), 1e-6);
  }
}

TEST(HeadProjection, TellsInvalidReadingsFromNoReturns) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Scan2 scan = project_scan(
      raw_scan({0.0F, nan, infinity, -infinity, -1.0F, 0.05F, 25.0F, 99.0F, 24.9F}, 0.0, 0.01), {});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(scan.beams[i].kind, BeamKind::invalid) << i;
  EXPECT_EQ(scan.beams[6].kind, BeamKind::no_return);
  EXPECT_EQ(scan.beams[7].kind, BeamKind::no_return);
  EXPECT_EQ(scan.beams[8].kind, BeamKind::hit);
}

TEST(HeadProjection, ReadingsBeyondTheConfiguredRangeAreNoReturns) {
  ProjectionConfig config;
  config.max_range_m = 4.0;
  const Scan2 scan = project_scan(raw_scan({3.9F, 4.0F}, 0.0, 0.01), config);
  EXPECT_EQ(scan.beams[0].kind, BeamKind::hit);
  EXPECT_EQ(scan.beams[1].kind, BeamKind::no_return);
}

TEST(HeadProjection, PitchShortensTheBeamAheadByItsCosine) {
  RawScan raw = raw_scan({2.0F, 2.0F}, 0.0, kPi / 2.0);
  raw.attitude = Attitude{0.0, 0.3, 1.0};
  const Scan2 scan = project_scan(raw, tall_building());
  EXPECT_NEAR(scan.beams[0].range_m, 2.0 * std::cos(0.3), 1e-6);  // Eq. 14
  EXPECT_NEAR(scan.beams[1].range_m, 2.0, 1e-6);                  // the axis of the nod
}

TEST(HeadProjection, PitchAloneStraightAheadIsThePapersFormula) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> angle(-0.9, 0.9), range(0.3, 12.0);
  ProjectionConfig config;
  config.height_margin_m = config.tilt_margin_rad = 0.0;
  const double h1 = config.sensor_height_m, hc = config.ceiling_height_m;
  int valid = 0;
  for (int i = 0; i < 20000; ++i) {
    const double phi = angle(random);  // looking up is positive
    const float r = static_cast<float>(range(random));
    RawScan raw = raw_scan({r}, 0.0, 0.01);
    raw.attitude = Attitude{0.0, -phi, 0.0};
    // Eq. 14 with the sign that its lower bound needs: looking down is negative.
    const double lowest = -std::asin(std::min(h1 / r, 1.0));
    const double highest = std::asin(std::min((hc - h1) / r, 1.0));
    const Beam2 beam = project_scan(raw, config).beams.at(0);
    if (std::min(std::abs(phi - lowest), std::abs(phi - highest)) < 1e-9) continue;
    ASSERT_EQ(beam.kind == BeamKind::hit, lowest < phi && phi < highest) << phi << ' ' << r;
    if (beam.kind != BeamKind::hit) continue;
    EXPECT_NEAR(beam.range_m, r * std::cos(phi), 1e-6);
    ++valid;
  }
  EXPECT_GT(valid, 5000);
  EXPECT_LT(valid, 15000);
}

TEST(HeadProjection, ALidarMountedAslantIsStraightenedByItsMount) {
  // Nose down by 10 deg on a head that looks up by 10 deg: level in space.
  RawScan raw = raw_scan({20.0F}, 0.0, 0.01);
  raw.attitude = Attitude{0.0, -kPi / 18.0, 0.0};
  ProjectionConfig config;
  config.mount.pitch_rad = kPi / 18.0;
  const Scan2 scan = project_scan(raw, config);
  ASSERT_EQ(scan.beams[0].kind, BeamKind::hit);
  EXPECT_NEAR(scan.beams[0].range_m, 20.0, 1e-5);
}

TEST(HeadProjection, ANodAboutTheNeckMovesTheLidarForwardAndDown) {
  RawScan raw = raw_scan({2.0F}, 0.0, 0.01);
  raw.attitude = Attitude{0.0, 0.4, 0.0};
  ProjectionConfig config = tall_building();
  config.mount.lever_body_m = {0.0, 0.0, 0.3};
  const Scan2 scan = project_scan(raw, config);
  EXPECT_NEAR(scan.beams[0].x_m, 2.0 * std::cos(0.4) + 0.3 * std::sin(0.4), 1e-6);
  config.sensor_height_m = 2.0 * std::sin(0.4) + 0.3 * (1.0 - std::cos(0.4)) + 0.001;
  config.height_margin_m = config.tilt_margin_rad = 0.0;
  EXPECT_EQ(project_scan(raw, config).beams[0].kind, BeamKind::hit);
  config.sensor_height_m -= 0.002;
  EXPECT_EQ(project_scan(raw, config).beams[0].kind, BeamKind::invalid);
}

TEST(HeadProjection, TheMarginGrowsWithTheRange) {
  RawScan raw = raw_scan({10.0F, 10.0F}, 0.0, 1e-9);
  ProjectionConfig config;
  config.height_margin_m = 0.1;
  config.tilt_margin_rad = 0.02;  // 0.2 m at 10 m
  const auto ends_at_height = [&](double height_m) {
    raw.attitude = Attitude{0.0, std::asin((config.sensor_height_m - height_m) / 10.0), 0.0};
    return project_scan(raw, config).beams[0].kind;
  };
  EXPECT_EQ(ends_at_height(0.31), BeamKind::hit);
  EXPECT_EQ(ends_at_height(0.29), BeamKind::invalid);
  EXPECT_EQ(ends_at_height(config.ceiling_height_m - 0.31), BeamKind::hit);
  EXPECT_EQ(ends_at_height(config.ceiling_height_m - 0.29), BeamKind::invalid);
}

TEST(HeadProjection, NodingDownCutsOffBeamsThatMeetTheFloor) {
  RawScan raw = raw_scan({3.0F, 9.0F}, 0.0, 1e-6);
  raw.attitude = Attitude{0.0, 0.3, 0.0};
  ProjectionConfig config;
  config.sensor_height_m = 1.8;
  config.height_margin_m = 0.0;
  // The floor is met at 1.8 / sin(0.3) = 6.09 m.
  const Scan2 scan = project_scan(raw, config);
  EXPECT_EQ(scan.beams[0].kind, BeamKind::hit);
  EXPECT_EQ(scan.beams[1].kind, BeamKind::invalid);
}

TEST(HeadProjection, LookingUpCutsOffBeamsThatMeetTheCeiling) {
  RawScan raw = raw_scan({2.0F, 3.0F}, 0.0, 1e-6);
  raw.attitude = Attitude{0.0, -0.3, 0.0};
  ProjectionConfig config;
  config.sensor_height_m = 1.8;
  config.ceiling_height_m = 2.5;
  config.height_margin_m = 0.0;
  // The ceiling is met at 0.7 / sin(0.3) = 2.37 m.
  const Scan2 scan = project_scan(raw, config);
  EXPECT_EQ(scan.beams[0].kind, BeamKind::hit);
  EXPECT_EQ(scan.beams[1].kind, BeamKind::invalid);
}

TEST(HeadProjection, RollCutsOffOneSideOnly) {
  // Leaning to the right (roll > 0 lifts the left side): the right beam looks down.
  RawScan raw = raw_scan({9.0F, 9.0F}, -kPi / 2.0, kPi);
  raw.attitude = Attitude{0.3, 0.0, 0.0};
  ProjectionConfig config = tall_building();
  config.sensor_height_m = 1.8;
  const Scan2 scan = project_scan(raw, config);
  EXPECT_EQ(scan.beams[0].kind, BeamKind::invalid);  // right: floor
  EXPECT_EQ(scan.beams[1].kind, BeamKind::hit);      // left: up, under a high ceiling
}

/// Independent 3D geometry: a box-shaped room, the beam followed to whatever it meets first.
struct Room {
  double x0 = -3.0, x1 = 5.0, y0 = -4.0, y1 = 2.5, floor = -1.7, ceiling = 0.9;

  struct Met {
    double range_m;
    bool wall;
  };
  [[nodiscard]] Met follow(const Eigen::Vector3d& d) const {
    const double to_x = d.x() > 0 ? x1 / d.x() : x0 / d.x();
    const double to_y = d.y() > 0 ? y1 / d.y() : y0 / d.y();
    const double to_z = d.z() > 0 ? ceiling / d.z() : floor / d.z();
    const double to_wall = std::min(to_x, to_y);
    return {std::min(to_wall, to_z), to_wall < to_z};
  }
};

TEST(HeadProjection, TiltedScansOfARoomProjectBackOntoItsWallsAndNothingElse) {
  const Room room;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> tilt(-0.5, 0.5);
  ProjectionConfig config;
  config.sensor_height_m = 1.7;
  config.ceiling_height_m = 2.6;
  config.height_margin_m = 0.01;
  std::size_t walls = 0, cut = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Attitude attitude{tilt(random), tilt(random), 0.0};
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(attitude.pitch_rad, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(attitude.roll_rad, Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix();
    RawScan raw = raw_scan({}, -kPi, kPi / 90.0);
    raw.attitude = attitude;
    std::vector<bool> is_wall;
    for (int i = 0; i < 180; ++i) {
      const double a = -kPi + i * kPi / 90.0;
      const Room::Met met = room.follow(R * Eigen::Vector3d(std::cos(a), std::sin(a), 0.0));
      raw.ranges_m.push_back(static_cast<float>(met.range_m));
      is_wall.push_back(met.wall);
    }
    const Scan2 scan = project_scan(raw, config);
    for (std::size_t i = 0; i < scan.beams.size(); ++i) {
      const Beam2& beam = scan.beams[i];
      if (!is_wall[i]) {
        EXPECT_NE(beam.kind, BeamKind::hit);
        ++cut;
      } else if (beam.kind == BeamKind::hit) {
        const double off = std::min({std::abs(beam.x_m - room.x0), std::abs(beam.x_m - room.x1),
                                     std::abs(beam.y_m - room.y0), std::abs(beam.y_m - room.y1)});
        EXPECT_LT(off, 1e-4);
        ++walls;
      }
    }
  }
  EXPECT_GT(walls, 10000U);
  EXPECT_GT(cut, 1000U);
}

TEST(HeadProjection, ScansNothingCanBeMadeOfGiveNoBeams) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(project_scan(raw_scan({}, 0.0, 0.01), {}).beams.empty());
  EXPECT_TRUE(project_scan(raw_scan({1.0F, 1.0F}, nan, 0.01), {}).beams.empty());
  EXPECT_TRUE(project_scan(raw_scan({1.0F, 1.0F}, 0.0, nan), {}).beams.empty());
  EXPECT_TRUE(project_scan(raw_scan({1.0F, 1.0F}, 0.0, 0.0), {}).beams.empty());
  EXPECT_TRUE(project_scan(raw_scan(std::vector<float>(20000, 1.0F), 0.0, 1e-4), {}).beams.empty());
  RawScan upside_down = raw_scan({1.0F, 1.0F}, 0.0, 0.1);
  upside_down.attitude = Attitude{3.0, 0.0, 0.0};
  EXPECT_TRUE(project_scan(upside_down, {}).beams.empty());
  upside_down.attitude = Attitude{nan, 0.0, 0.0};
  EXPECT_TRUE(project_scan(upside_down, {}).beams.empty());
}

TEST(HeadProjection, OneBeamIsAScanToo) {
  const Scan2 scan = project_scan(raw_scan({2.0F}, 0.0, 0.01), {});
  ASSERT_EQ(scan.beams.size(), 1U);
  EXPECT_EQ(scan.hits(), 1U);
  EXPECT_FALSE(scan.full_circle);
}

TEST(HeadProjection, KnowsWhetherTheSweepCloses) {
  const std::vector<float> ranges(360, 2.0F);
  EXPECT_TRUE(project_scan(raw_scan(ranges, -kPi, kPi / 180.0), {}).full_circle);
  EXPECT_TRUE(project_scan(raw_scan(ranges, kPi, -kPi / 180.0), {}).full_circle);
  EXPECT_FALSE(project_scan(raw_scan(ranges, -kPi / 2.0, kPi / 360.0), {}).full_circle);
}

TEST(HeadProjection, LongSweepsDoNotTurnTheBeamsAway) {
  const Scan2 scan =
      project_scan(raw_scan(std::vector<float>(18000, 2.0F), -kPi, kPi / 9000.0), {});
  EXPECT_NEAR(scan.beams.back().x_m, 2.0 * std::cos(kPi - kPi / 9000.0), 1e-5);
  EXPECT_NEAR(scan.beams.back().y_m, 2.0 * std::sin(kPi - kPi / 9000.0), 1e-5);
}

}  // namespace
}  // namespace lifeline::sensing
