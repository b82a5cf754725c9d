#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/houseexpo.hpp"
#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

/// The slow way: every wall.
double cast_slowly(std::span<const WallSegment> walls, const Eigen::Vector2d& origin,
                   const Eigen::Vector2d& direction, double range_max_m) {
  double best_m = std::numeric_limits<double>::infinity();
  for (const WallSegment& wall : walls) {
    best_m = std::min(best_m, ray_to_wall(origin, direction, wall));
  }
  return best_m <= range_max_m ? best_m : std::numeric_limits<double>::infinity();
}

/// Any direction, often along an axis or a diagonal, where ties and corners are.
Eigen::Vector2d draw_direction(Draw& draw) {
  const double eighth = 0.25 * std::numbers::pi;
  if (draw.chance(0.1)) return Eigen::Vector2d::Unit(draw.below(2)) * (draw.chance(0.5) ? 1 : -1);
  const double angle =
      draw.chance(0.1) ? eighth * draw.below(8) : draw.between(-std::numbers::pi, std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

/// Anywhere in and a little around the box, or exactly at a wall's end.
Eigen::Vector2d draw_origin(Draw& draw, std::span<const WallSegment> walls,
                            const Eigen::AlignedBox2d& box) {
  if (draw.chance(0.05)) {
    return walls[static_cast<std::size_t>(draw.below(static_cast<int>(walls.size())))].a;
  }
  return {draw.between(box.min().x() - 2.0, box.max().x() + 2.0),
          draw.between(box.min().y() - 2.0, box.max().y() + 2.0)};
}

void expect_like_slow(std::span<const WallSegment> walls, Draw& draw, int rays) {
  const RayScene scene(walls);
  Eigen::AlignedBox2d box;
  for (const WallSegment& wall : walls) box.extend(wall.a).extend(wall.b);
  for (int i = 0; i < rays; ++i) {
    const Eigen::Vector2d origin = draw_origin(draw, walls, box);
    const Eigen::Vector2d direction = draw_direction(draw);
    const double range_max_m = draw.chance(0.3) ? draw.between(0.0, 5.0) : 25.0;
    ASSERT_EQ(scene.cast(origin, direction, range_max_m),
              cast_slowly(walls, origin, direction, range_max_m))
        << "from " << origin.transpose() << " towards " << direction.transpose() << " up to "
        << range_max_m;
  }
}

TEST(RayScenePropertyTest, AgreesWithTheSlowWayInOffices) {
  Draw draw(1);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const FloorPlan plan =
        generate_office({.seed = seed, .width_m = 25.0, .depth_m = 18.0}).value();
    expect_like_slow(plan.walls, draw, 3000);
  }
}

TEST(RayScenePropertyTest, AgreesWithTheSlowWayInHouseExpoPlans) {
  const auto files = support::houseexpo_files();
  if (files.empty()) GTEST_SKIP() << "the HouseExpo plans are not here";
  Draw draw(2);
  for (std::size_t i = 0; i < files.size(); i += 6) {
    SCOPED_TRACE(files[i]);
    const FloorPlan plan = read_houseexpo(files[i]).value();
    expect_like_slow(plan.walls, draw, 500);
  }
}

TEST(RayScenePropertyTest, AgreesWithTheSlowWayAmongWallsAnyhow) {
  Draw draw(3);
  for (int scene = 0; scene < 30; ++scene) {
    SCOPED_TRACE(scene);
    std::vector<WallSegment> walls;
    const double size_m = draw.between(0.5, 40.0);
    const auto place = [&]() -> Eigen::Vector2d {
      // Sometimes on multiples of the fields' side, where rounding is at its worst.
      if (draw.chance(0.3)) return {0.4 * draw.below(50), 0.4 * draw.below(50)};
      return {draw.between(0.0, size_m), draw.between(0.0, size_m)};
    };
    for (int i = draw.below(60); i >= 0; --i) {
      const Eigen::Vector2d a = place();
      walls.push_back({a, draw.chance(0.3) ? Eigen::Vector2d(a.x(), place().y()) : place()});
    }
    expect_like_slow(walls, draw, 500);
  }
}

TEST(RayScenePropertyTest, NoRayFromTheFloorLeavesAnOffice) {
  Draw draw(4);
  const FloorPlan plan = generate_office({.seed = 6, .width_m = 22.0, .depth_m = 16.0}).value();
  const RayScene scene(plan.walls);
  int rays = 0;
  while (rays < 5000) {
    const Eigen::Vector2d origin(draw.between(0.0, 22.0), draw.between(0.0, 16.0));
    if (!plan.is_floor(origin)) continue;
    ++rays;
    EXPECT_LT(scene.cast(origin, draw_direction(draw), 100.0), 28.0);
  }
}

}  // namespace
}  // namespace lifeline::sources
