#include "agents/sources/simulator/paper_buildings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/office_furniture.hpp"
#include "agents/sources/simulator/office_layout.hpp"

namespace lifeline::sources {
namespace {

constexpr double kLowestCeilingM = 2.2;
constexpr double kHighestCeilingM = 3.2;

bool is_in_one(const std::vector<Box>& boxes, const Box& part) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Box& box) { return box.contains(part); });
}

/// Turns what stands beside a door along a corridor into a front of glass: an opening with a pane
/// in its middle, framed by what is left of the wall. Both sides must be floor for all its length.
class GlassFronts {
 public:
  GlassFronts(OfficeLayout& layout, std::vector<WallSegment>& panes)
      : layout_(layout), panes_(panes) {}

  void glaze() {
    const std::vector<Box> openings = layout_.openings;  // of doors: more are added
    for (std::size_t i = 0; i < openings.size(); ++i) {
      if (layout_.doorways[i].a.y() == layout_.doorways[i].b.y()) glaze_beside(openings[i]);
    }
  }

 private:
  static constexpr double kFrameM = 0.1;
  static constexpr double kLeastM = 0.6;

  void glaze_beside(const Box& door) {
    for (const Box& room : layout_.rooms) {
      const bool touches = room.min().y() == door.max().y() || room.max().y() == door.min().y();
      if (!touches || room.min().x() > door.min().x() || room.max().x() < door.max().x()) continue;
      add_front(room.min().x() + kFrameM, door.min().x() - kFrameM, door);
      add_front(door.max().x() + kFrameM, room.max().x() - kFrameM, door);
    }
  }

  void add_front(double low, double high, const Box& door) {
    if (high - low < kLeastM) return;
    const Box front(Eigen::Vector2d(low, door.min().y()), Eigen::Vector2d(high, door.max().y()));
    const Eigen::Vector2d up(0.0, 0.05);
    const Box above(front.min() + Eigen::Vector2d(0.0, front.sizes().y()), front.max() + up);
    const Box below(front.min() - up, front.max() - Eigen::Vector2d(0.0, front.sizes().y()));
    const bool corridor =
        is_in_one(layout_.corridors, above) || is_in_one(layout_.corridors, below);
    const bool room = is_in_one(layout_.rooms, above) || is_in_one(layout_.rooms, below);
    if (!corridor || !room) return;
    const double middle = front.center().y();
    layout_.openings.push_back(front);
    panes_.push_back({{low, middle}, {high, middle}});
  }

  OfficeLayout& layout_;
  std::vector<WallSegment>& panes_;
};

/// Windows: what of the outer walls is long enough, by chance.
void add_windows(double width_m, double depth_m, Draw& draw, FloorPlan& plan) {
  constexpr double kShare = 0.5, kLeastM = 1.5;
  plan.materials.assign(plan.walls.size(), Material::plain);
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const WallSegment& wall = plan.walls[i];
    const bool glass = draw.chance(kShare);
    const auto is_along = [&](double a, double b, double side_m) {
      return a == b && (a <= kOuterWallM || a >= side_m - kOuterWallM);
    };
    const bool outer =
        is_along(wall.a.x(), wall.b.x(), width_m) || is_along(wall.a.y(), wall.b.y(), depth_m);
    if (glass && outer && (wall.b - wall.a).norm() >= kLeastM) plan.materials[i] = Material::glass;
  }
}

}  // namespace

std::optional<PaperBuilding> find_paper_building(std::string_view name) {
  for (const NamedBuilding& known : kPaperBuildings) {
    if (known.name == name) return known.building;
  }
  return std::nullopt;
}

FloorPlan generate_paper_building(PaperBuilding building, std::uint64_t seed) {
  const bool meeting = building == PaperBuilding::meeting;
  const bool karaoke = building == PaperBuilding::karaoke;
  const double width_m = meeting ? 20.0 : karaoke ? 18.0 : 14.0;
  const double depth_m = karaoke ? 18.0 : 14.0;
  const std::uint64_t stirred = stir(seed, 50 + static_cast<std::uint64_t>(building));
  Draw layout_draw(stir(stirred, 0)), furniture_draw(stir(stirred, 1)), draw(stir(stirred, 2));
  OfficeLayout layout = lay_out_office(width_m, depth_m, layout_draw);
  const OfficeFurniture furniture = furnish_office(layout, furniture_draw);
  std::vector<WallSegment> panes;
  if (meeting) GlassFronts(layout, panes).glaze();
  FloorPlan plan = build_office(layout, furniture);
  plan.panes = std::move(panes);
  plan.name =
      fmt::format("{}, seed {}", kPaperBuildings[static_cast<std::size_t>(building)].name, seed);
  if (meeting) add_windows(width_m, depth_m, draw, plan);
  for (Doorway& doorway : plan.doorways) doorway.glass = meeting || karaoke;
  if (!karaoke) return plan;
  for (const Box& room : layout.rooms) {
    plan.ceilings.push_back({room, draw.between(kLowestCeilingM, kHighestCeilingM)});
  }
  return plan;
}

}  // namespace lifeline::sources
