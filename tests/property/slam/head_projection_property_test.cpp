// The projection against geometry in space that shares nothing with it: rooms with walls in any
// direction, rays followed to whatever they meet first.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sensing/head_projection.hpp"
#include "common/base/angles.hpp"

namespace lifeline::sensing {
namespace {

constexpr double kPi = std::numbers::pi;

struct Vec {
  double x, y, z;
};

/// What Rz(yaw) Ry(pitch) Rx(roll) makes of v, one axis after the other.
Vec turned(const Vec& v, double roll, double pitch, double yaw) {
  const Vec rolled{v.x, std::cos(roll) * v.y - std::sin(roll) * v.z,
                   std::sin(roll) * v.y + std::cos(roll) * v.z};
  const Vec pitched{std::cos(pitch) * rolled.x + std::sin(pitch) * rolled.z, rolled.y,
                    -std::sin(pitch) * rolled.x + std::cos(pitch) * rolled.z};
  return {std::cos(yaw) * pitched.x - std::sin(yaw) * pitched.y,
          std::sin(yaw) * pitched.x + std::cos(yaw) * pitched.y, pitched.z};
}

/// Four walls in any direction, a floor at height 0 and a ceiling. The head is inside.
struct Room {
  struct Wall {
    double normal_rad, distance_m;  ///< from the origin, outwards
  };
  std::vector<Wall> walls;
  double ceiling_m;

  struct Met {
    double range_m;
    bool wall;
    double edge_m;  ///< from the point met to the wall's nearer edge, upper or lower
  };
  [[nodiscard]] Met follow(const Vec& from, const Vec& d) const {
    double to_wall = 1e9, to_plane = 1e9;
    for (const Wall& wall : walls) {
      const double c = std::cos(wall.normal_rad), s = std::sin(wall.normal_rad);
      const double towards = c * d.x + s * d.y;
      if (towards > 0.0) {
        to_wall = std::min(to_wall, (wall.distance_m - c * from.x - s * from.y) / towards);
      }
    }
    if (d.z < 0.0) to_plane = from.z / -d.z;
    if (d.z > 0.0) to_plane = (ceiling_m - from.z) / d.z;
    const double height_at_wall = from.z + to_wall * d.z;
    const double edge_m = std::min(std::abs(height_at_wall), std::abs(ceiling_m - height_at_wall));
    return {std::min(to_wall, to_plane), to_wall < to_plane, edge_m};
  }
};

class World {
 public:
  explicit World(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Room room() {
    Room room{{}, between(2.2, 4.0)};
    const double turned_rad = between(0.0, kPi);
    for (int i = 0; i < 4; ++i) {
      room.walls.push_back({turned_rad + i * 0.5 * kPi + between(-0.3, 0.3), between(0.7, 12.0)});
    }
    return room;
  }

 private:
  std::mt19937 random_;
};

/// A lidar on a head that leans about the neck; the neck does not move.
struct Helmet {
  LidarMount mount;
  double lidar_height_m = 1.7;

  [[nodiscard]] Vec lidar_at(const Attitude& a) const {
    const Vec lever{mount.lever_body_m.x(), mount.lever_body_m.y(), mount.lever_body_m.z()};
    // The head frame stands where the lidar is when the head is level.
    const Vec now = turned(lever, a.roll_rad, a.pitch_rad, a.yaw_rad);
    const Vec level = turned(lever, 0.0, 0.0, heading_rad);
    return {now.x - level.x, now.y - level.y, lidar_height_m + now.z - lever.z};
  }
  [[nodiscard]] Vec beam(const Attitude& a, double angle) const {
    const Vec in_laser{std::cos(angle), std::sin(angle), 0.0};
    return turned(turned(in_laser, mount.roll_rad, mount.pitch_rad, mount.yaw_rad), a.roll_rad,
                  a.pitch_rad, a.yaw_rad);
  }
  double heading_rad = 0.0;  ///< at the stamp
};

struct Tally {
  std::size_t walls = 0, planes = 0, at_edge = 0;
  std::size_t walls_refused = 0, planes_accepted = 0;
  double worst_m = 0.0;
};

struct Expected {
  Room::Met met;
  Vec p_head;
};

/// Where the point met lies in the head frame of the stamp.
Expected expect(const Room& room, const Helmet& helmet, const Attitude& attitude, double angle) {
  const Vec from = helmet.lidar_at(attitude), d = helmet.beam(attitude, angle);
  const Room::Met met = room.follow(from, d);
  const Vec p{from.x + met.range_m * d.x, from.y + met.range_m * d.y, 0.0};
  return {met, turned(p, 0.0, 0.0, -helmet.heading_rad)};
}

void compare(const Beam2& beam, const Expected& expected, double edge_m, Tally& tally) {
  if (expected.met.edge_m < edge_m) {
    ++tally.at_edge;
  } else if (!expected.met.wall) {
    ++tally.planes;
    tally.planes_accepted += beam.kind == BeamKind::hit ? 1 : 0;
  } else {
    ++tally.walls;
    tally.walls_refused += beam.kind != BeamKind::hit ? 1 : 0;
    if (beam.kind != BeamKind::hit) return;
    const Vec& p = expected.p_head;
    const double off_m =
        std::hypot(static_cast<double>(beam.x_m) - p.x, static_cast<double>(beam.y_m) - p.y);
    // Direction and range say the same place.
    const double range_m = static_cast<double>(beam.range_m);
    const double also_m = std::hypot(range_m * std::cos(beam.angle_rad) - p.x,
                                     range_m * std::sin(beam.angle_rad) - p.y);
    tally.worst_m = std::max({tally.worst_m, off_m, also_m});
  }
}

RawScan blank(std::size_t beams, double first_rad) {
  RawScan raw;
  raw.first_angle_rad = first_rad;
  raw.angle_step_rad = 2.0 * kPi / static_cast<double>(beams);
  raw.range_max_m = 1000.0;
  raw.ranges_m.reserve(beams);
  return raw;
}

/// Only geometry decides; what is left is the rounding of a range to float.
ProjectionConfig exact(const Helmet& helmet, const Room& room) {
  ProjectionConfig config;
  config.max_range_m = 1000.0;
  config.sensor_height_m = helmet.lidar_height_m;
  config.ceiling_height_m = room.ceiling_m;
  config.height_margin_m = 1e-5;
  config.tilt_margin_rad = 0.0;
  config.mount = helmet.mount;
  return config;
}

Helmet any_helmet(World& world) {
  Helmet helmet;
  helmet.mount = {world.between(-10.0, 10.0) * kDegree,
                  world.between(-10.0, 10.0) * kDegree,
                  world.between(-kPi, kPi),
                  {world.between(-0.2, 0.2), world.between(-0.1, 0.1), world.between(0.0, 0.35)}};
  helmet.lidar_height_m = world.between(1.2, 1.9);
  helmet.heading_rad = world.between(-kPi, kPi);
  return helmet;
}

TEST(HeadProjectionProperty, AMillionRaysAtAnyAttitudeEndWhereGeometryHasThem) {
  World world(20);
  Tally tally;
  constexpr std::size_t kBeams = 400;
  for (int trial = 0; trial < 2500; ++trial) {
    const Room room = world.room();
    const Helmet helmet = any_helmet(world);
    const Attitude attitude{world.between(-45.0, 45.0) * kDegree,
                            world.between(-45.0, 45.0) * kDegree, helmet.heading_rad};
    RawScan raw = blank(kBeams, world.between(-kPi, kPi));
    raw.attitude = attitude;
    std::vector<Expected> expected;
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double angle = raw.first_angle_rad + raw.angle_step_rad * static_cast<double>(i);
      expected.push_back(expect(room, helmet, attitude, angle));
      raw.ranges_m.push_back(static_cast<float>(expected.back().met.range_m));
    }
    const Scan2 scan = project_scan(raw, exact(helmet, room));
    ASSERT_EQ(scan.beams.size(), kBeams);
    // Closer than 20 um to where a wall meets floor or ceiling either answer is right.
    for (std::size_t i = 0; i < kBeams; ++i) compare(scan.beams[i], expected[i], 2e-5, tally);
  }
  RecordProperty("worst_um", static_cast<int>(1e6 * tally.worst_m));
  EXPECT_EQ(tally.walls + tally.planes + tally.at_edge, 1'000'000U);
  EXPECT_GT(tally.walls, 200'000U);
  EXPECT_GT(tally.planes, 200'000U);
  EXPECT_LT(tally.at_edge, 200U);
  EXPECT_EQ(tally.planes_accepted, 0U);
  EXPECT_EQ(tally.walls_refused, 0U);
  EXPECT_LT(tally.worst_m, 1e-3);
}

/// A head in motion: nods, rolls and turns, all at once.
Attitude moving_head(double t_s, double phase) {
  return {10.0 * kDegree * std::sin(2.0 * kPi * t_s / 4.0 + phase),
          25.0 * kDegree * std::sin(2.0 * kPi * t_s / 2.6 + 2.0 * phase),
          0.3 + 90.0 * kDegree * t_s};
}

TEST(HeadProjectionProperty, ASweepOfAHeadInMotionLiesOnTheWallsToo) {
  World world(21);
  Tally with, without;
  constexpr std::size_t kBeams = 400;
  for (int trial = 0; trial < 200; ++trial) {
    const Room room = world.room();
    Helmet helmet = any_helmet(world);
    const double phase = world.between(0.0, 2.0 * kPi);
    const auto head_at = [&](double t_s) { return moving_head(t_s, phase); };
    helmet.heading_rad = head_at(0.0).yaw_rad;
    RawScan raw = blank(kBeams, world.between(-kPi, kPi));
    raw.sweep_time = std::chrono::milliseconds(100);
    raw.attitude = head_at(0.0);
    for (int ms = 7; ms <= 107; ms += 10) {  // a sensor of 100 Hz that knows no sweeps
      raw.later_attitudes.push_back({std::chrono::milliseconds(ms), head_at(1e-3 * ms)});
    }
    std::vector<Expected> expected;
    for (std::size_t i = 0; i < kBeams; ++i) {
      const auto share = static_cast<double>(i) / (kBeams - 1.0);
      const double angle = raw.first_angle_rad + raw.angle_step_rad * static_cast<double>(i);
      expected.push_back(expect(room, helmet, head_at(0.1 * share), angle));
      raw.ranges_m.push_back(static_cast<float>(expected.back().met.range_m));
    }
    ProjectionConfig config = exact(helmet, room);
    config.height_margin_m = 1e-3;
    const Scan2 scan = project_scan(raw, config);
    EXPECT_TRUE(scan.turn_undone);
    raw.later_attitudes.clear();
    const Scan2 held = project_scan(raw, config);
    EXPECT_FALSE(held.turn_undone);
    for (std::size_t i = 0; i < kBeams; ++i) {
      compare(scan.beams[i], expected[i], 2e-3, with);
      compare(held.beams[i], expected[i], 2e-3, without);
    }
  }
  EXPECT_EQ(with.planes_accepted, 0U);
  EXPECT_EQ(with.walls_refused, 0U);
  // What is left is the interpolation over 10 ms: 3e-5 rad at these speeds.
  EXPECT_LT(with.worst_m, 2e-3);
  EXPECT_GT(without.worst_m, 0.5);
  EXPECT_GT(without.planes_accepted, 100U);
}

TEST(HeadProjectionProperty, WithinTheMarginsErrorsLetNoFloorOrCeilingIn) {
  World world(22);
  Tally tally;
  constexpr std::size_t kBeams = 400;
  for (int trial = 0; trial < 500; ++trial) {
    const Room room = world.room();
    Helmet helmet;
    const Attitude attitude{world.between(-25.0, 25.0) * kDegree,
                            world.between(-25.0, 25.0) * kDegree, 0.0};
    RawScan raw = blank(kBeams, -kPi);
    // What the helmet believes is a little off.
    raw.attitude = Attitude{attitude.roll_rad + world.between(-0.4, 0.4) * kDegree,
                            attitude.pitch_rad + world.between(-0.4, 0.4) * kDegree, 0.0};
    ProjectionConfig config;
    config.ceiling_height_m = room.ceiling_m + world.between(-0.1, 0.1);
    config.sensor_height_m = helmet.lidar_height_m + world.between(-0.02, 0.02);
    std::vector<Expected> expected;
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double angle = raw.first_angle_rad + raw.angle_step_rad * static_cast<double>(i);
      expected.push_back(expect(room, helmet, attitude, angle));
      raw.ranges_m.push_back(
          static_cast<float>(expected.back().met.range_m + world.between(-0.03, 0.03)));
    }
    const Scan2 scan = project_scan(raw, config);
    for (std::size_t i = 0; i < kBeams; ++i) compare(scan.beams[i], expected[i], 0.0, tally);
  }
  EXPECT_EQ(tally.planes_accepted, 0U);
  // The price: walls within the margins, and a little more where heights are believed too low.
  const double refused =
      static_cast<double>(tally.walls_refused) / static_cast<double>(tally.walls);
  RecordProperty("walls_refused_percent", static_cast<int>(100.0 * refused));
  EXPECT_LT(refused, 0.2);
  EXPECT_GT(refused, 0.01);
}

}  // namespace
}  // namespace lifeline::sensing
