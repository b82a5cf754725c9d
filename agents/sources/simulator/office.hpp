#pragma once

#include <cstdint>

#include "agents/sources/simulator/office_furniture.hpp"
#include "agents/sources/simulator/office_layout.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// A building to be generated.
struct OfficeOptions {
  static constexpr double kLeastSideM = 10.0;
  static constexpr double kLargestSideM = 120.0;

  std::uint64_t seed = 1;
  double width_m = 22.0;  ///< along x, outer faces
  double depth_m = 16.0;  ///< along y, outer faces
};

/// Makes up one storey of an office building: the same one for the same options, another one for
/// another seed. Rooms of differing size, corridors with a jog, doorways of 0.9 m, outer walls of
/// 0.2 m, inner walls of 0.10 to 0.15 m, furniture and pillars; nothing repeats or mirrors. The
/// lower left corner of the outer walls is the world's origin. wrong_use for a side outside the
/// limits.
[[nodiscard]] Result<FloorPlan> generate_office(const OfficeOptions& options);

/// The plan of a floor that was laid out and furnished: walls, outline, rooms and doorways.
[[nodiscard]] FloorPlan build_office(const OfficeLayout& layout, const OfficeFurniture& furniture);

}  // namespace lifeline::sources
