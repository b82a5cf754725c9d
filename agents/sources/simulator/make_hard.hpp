#pragma once

#include <cstdint>

#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// What makes a building hard on a lidar.
struct Hardships {
  double glass_share = 0.0;       ///< of the doors, and of the outer walls' faces (windows)
  double black_share = 0.0;       ///< of all faces: they give no reading
  double ceiling_spread_m = 0.0;  ///< each room's ceiling is up to so much higher or lower
};

/// Puts them into a plan whose ceiling is at `ceiling_m`: the same for the same seed. Faces shorter
/// than 0.5 m stay as they are. wrong_use where ceilings are to differ in a plan that tells of no
/// rooms, or to be lower than 2 m.
[[nodiscard]] Result<void> make_hard(const Hardships& hardships, double ceiling_m,
                                     std::uint64_t seed, FloorPlan& plan);

}  // namespace lifeline::sources
