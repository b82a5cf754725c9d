#include "agents/sources/simulator/office.hpp"

namespace lifeline::sources {

Result<FloorPlan> generate_office(const OfficeOptions& options) {
  for (const double side : {options.width_m, options.depth_m}) {
    if (!(side >= OfficeOptions::kLeastSideM && side <= OfficeOptions::kLargestSideM)) {
      return fail(ErrorCode::wrong_use, "office: a side of {} m is outside of {} to {} m", side,
                  OfficeOptions::kLeastSideM, OfficeOptions::kLargestSideM);
    }
  }
  Draw layout_draw(stir(options.seed, 0)), furniture_draw(stir(options.seed, 1));
  const OfficeLayout layout = lay_out_office(options.width_m, options.depth_m, layout_draw);
  const OfficeFurniture furniture = furnish_office(layout, furniture_draw);

  FloorPlan plan = build_office(layout, furniture);
  plan.name = fmt::format("office, seed {}", options.seed);
  return plan;
}

FloorPlan build_office(const OfficeLayout& layout, const OfficeFurniture& furniture) {
  std::vector<Box> floors, with_outer_walls;
  for (const auto* boxes : {&layout.rooms, &layout.corridors, &layout.openings}) {
    floors.insert(floors.end(), boxes->begin(), boxes->end());
  }
  const Eigen::Vector2d thickness(kOuterWallM, kOuterWallM);
  for (const Box& floor : floors) {
    with_outer_walls.emplace_back(floor.min() - thickness, floor.max() + thickness);
  }
  FloorPlan plan;
  plan.walls = border_of(floors, furniture.boxes);
  plan.walls.insert(plan.walls.end(), furniture.loops.begin(), furniture.loops.end());
  plan.outline = border_of(with_outer_walls, {});
  plan.doorways = layout.doorways;
  plan.rooms = layout.rooms;
  return plan;
}

}  // namespace lifeline::sources
