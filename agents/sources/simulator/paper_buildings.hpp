#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "agents/sources/simulator/plan.hpp"

namespace lifeline::sources {

/// The buildings of the paper's four experiments, after what it says of them: it gives sizes and
/// kinds of rooms, no plans.
enum class PaperBuilding {
  testbed,     ///< 14 m x 14 m, rooms with doors
  rearranged,  ///< the same outer walls, all rooms rearranged
  meeting,     ///< 20 m x 14 m: meeting rooms with glass fronts and doors, windows
  karaoke,     ///< 18 m x 18 m: rooms with glass doors and ceilings of differing height
};

struct NamedBuilding {
  std::string_view name;
  PaperBuilding building;
};

/// As `sim:NAME` calls them, in the order of the experiments.
inline constexpr std::array<NamedBuilding, 4> kPaperBuildings{{
    {"testbed", PaperBuilding::testbed},
    {"rearranged", PaperBuilding::rearranged},
    {"meeting", PaperBuilding::meeting},
    {"karaoke", PaperBuilding::karaoke},
}};

[[nodiscard]] std::optional<PaperBuilding> find_paper_building(std::string_view name);

/// One of them: the same for the same seed, with other rooms for another one.
[[nodiscard]] FloorPlan generate_paper_building(PaperBuilding building, std::uint64_t seed);

}  // namespace lifeline::sources
