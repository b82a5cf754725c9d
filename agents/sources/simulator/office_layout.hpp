#pragma once

#include <cmath>
#include <vector>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/rectilinear.hpp"

namespace lifeline::sources {

/// Where an office building's floor is, before anything stands on it. Metres, lower left corner of
/// the outer walls at the origin.
struct OfficeLayout {
  std::vector<Box> rooms;
  std::vector<Box> corridors;
  std::vector<Box> openings;  ///< through the walls, as deep as they are: one for each doorway
  std::vector<Doorway> doorways;
};

inline constexpr double kOuterWallM = 0.20;
inline constexpr double kCorridorWallM = 0.15;
inline constexpr double kDoorwayM = 0.90;

/// `value_m` in whole centimetres: what an office is built of.
[[nodiscard]] inline double to_centimetres(double value_m) {
  return std::round(value_m * 100.0) / 100.0;
}

/// Lays out corridors that run along x, with a jog from section to section, rooms of differing
/// width on their sides, and cross corridors. `width_m` along x, `depth_m` along y, both at least
/// 10 m. Every room can be reached.
[[nodiscard]] OfficeLayout lay_out_office(double width_m, double depth_m, Draw& draw);

}  // namespace lifeline::sources
