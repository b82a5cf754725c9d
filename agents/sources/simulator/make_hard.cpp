#include "agents/sources/simulator/make_hard.hpp"

#include <cmath>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/ray_scene.hpp"

namespace lifeline::sources {
namespace {

constexpr double kShortM = 0.5;
constexpr double kLowestCeilingM = 2.0;

/// Whether behind the face there is nothing more of the building.
bool is_outer(const FloorPlan& plan, const RayScene& scene, const WallSegment& wall) {
  constexpr double kJustBehindM = 0.01, kFarM = 200.0;
  const Eigen::Vector2d middle = 0.5 * (wall.a + wall.b);
  const Eigen::Vector2d along = (wall.b - wall.a).normalized();
  Eigen::Vector2d outwards(-along.y(), along.x());
  if (plan.is_floor(middle + kJustBehindM * outwards)) outwards = -outwards;
  return !std::isfinite(scene.cast(middle + kJustBehindM * outwards, outwards, kFarM));
}

void choose_materials(const Hardships& hardships, Draw& draw, FloorPlan& plan) {
  const RayScene scene(plan.walls);
  plan.materials.resize(plan.walls.size(), Material::plain);
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const WallSegment& wall = plan.walls[i];
    const bool glass = draw.chance(hardships.glass_share);
    const bool black = draw.chance(hardships.black_share);
    if ((wall.b - wall.a).norm() < kShortM) continue;
    if (glass && is_outer(plan, scene, wall)) {
      plan.materials[i] = Material::glass;
    } else if (black) {
      plan.materials[i] = Material::black;
    }
  }
}

}  // namespace

Result<void> make_hard(const Hardships& hardships, double ceiling_m, std::uint64_t seed,
                       FloorPlan& plan) {
  Draw draw(seed);
  if (hardships.ceiling_spread_m > 0.0) {
    if (plan.rooms.empty()) {
      return fail(ErrorCode::wrong_use,
                  "sim: ceiling_spread: {} tells of no rooms; only generated buildings do",
                  plan.name);
    }
    if (ceiling_m - hardships.ceiling_spread_m < kLowestCeilingM) {
      return fail(ErrorCode::wrong_use,
                  "sim: ceiling_spread={}: a room could be lower than {} m; give less than {}",
                  hardships.ceiling_spread_m, kLowestCeilingM, ceiling_m - kLowestCeilingM);
    }
    plan.ceilings.clear();
    for (const Eigen::AlignedBox2d& room : plan.rooms) {
      const double off_m = hardships.ceiling_spread_m * draw.between(-1.0, 1.0);
      plan.ceilings.push_back({room, ceiling_m + off_m});
    }
  }
  if (hardships.glass_share <= 0.0 && hardships.black_share <= 0.0) return {};
  choose_materials(hardships, draw, plan);
  for (Doorway& doorway : plan.doorways) {
    if (draw.chance(hardships.glass_share)) doorway.glass = true;
  }
  return {};
}

}  // namespace lifeline::sources
