#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/simulator/walk.hpp"
#include "common/base/result.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::test {

/// Which part of a floor a map shows, and in which frame.
struct SimulatedView {
  sources::WalkerNumber walker;
  double from_s = 0.0;  ///< of the walk
  double until_s = 40.0;
  Pose2 T_world_map;             ///< where the map's frame lies
  double drift_rad_per_m = 0.0;  ///< heading error that grows along the walk
  std::uint64_t noise_seed = 1;
};

/// A floor on which maps are made without SLAM: scans of a simulated walk are pushed at their true
/// poses plus 1.5 cm and 0.15 deg of noise, ranges with 1 cm.
class SimulatedFloor {
 public:
  /// bad_data where nobody can walk on the plan.
  [[nodiscard]] static Result<SimulatedFloor> make(sources::FloorPlan plan);

  [[nodiscard]] TsdGrid map(const SimulatedView& view) const;
  [[nodiscard]] const sources::FloorPlan& plan() const { return plan_; }

 private:
  SimulatedFloor(sources::FloorPlan plan, sources::FreeSpace space);

  sources::FloorPlan plan_;
  sources::RayScene scene_;
  std::unique_ptr<sources::FreeSpace> space_;  // walks point at it
};

/// The plan in a mirror: no turn and shift makes it the plan again.
[[nodiscard]] sources::FloorPlan mirrored(const sources::FloorPlan& plan);

/// A corridor with `rooms` rooms of one size on each side, all doors in the same place: shifting it
/// by one room or turning it by pi shows the same again.
[[nodiscard]] sources::FloorPlan repeated_rooms(int rooms, double room_width_m,
                                                double room_depth_m);

/// A square hall with a room behind each side: looks the same after a turn by pi / 2. With
/// `oblong_m` > 0 it is stretched along x, and the same after a turn by pi only.
[[nodiscard]] sources::FloorPlan symmetric_hall(double side_m, double room_m, double oblong_m);

}  // namespace lifeline::test
