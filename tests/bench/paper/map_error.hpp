#pragma once

#include "agents/sources/simulator/plan.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::bench {

/// How far a map is from the plan of its building.
struct MapError {
  /// Of the map's walls to the nearest wall, pane or doorway of the plan, mean; each counts at most
  /// 0.5 m.
  double wall_m = 0.0;
  double astray_share = 0.0;    ///< of the map's walls: more than 0.15 m from any of the plan
  double complete_share = 0.0;  ///< of the plan's walls: with a wall of the map within 0.15 m
};

/// Glass and what only furniture hides count against no map: the plan's opaque faces alone are
/// asked for.
[[nodiscard]] MapError map_error(const TsdGrid& map, const Pose2& T_world_map,
                                 const sources::FloorPlan& plan);

}  // namespace lifeline::bench
