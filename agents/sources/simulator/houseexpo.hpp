#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// What a HouseExpo file may hold at most: several times the largest plan of the data set.
inline constexpr std::size_t kMaxHouseExpoBytes = 16U << 20U;
inline constexpr std::size_t kMaxHouseExpoVertices = 100'000;
/// No plan is larger than this on a side, and none further from its origin than ten times that.
inline constexpr double kMaxPlanSideM = 200.0;
inline constexpr double kMaxWallsM = 50'000.0;  ///< of wall face, all together

/// Reads a HouseExpo plan (Li et al., IROS 2020): `verts` is one closed polygon in metres, the
/// border of the floor; its edges are the walls, inner walls are slits of it, and it may touch
/// itself. Everything else in the text is passed over. `name` stands in messages. bad_data with one
/// line for anything else than that.
[[nodiscard]] Result<FloorPlan> parse_houseexpo(std::string_view json, const std::string& name);

/// The same from a file.
[[nodiscard]] Result<FloorPlan> read_houseexpo(const std::filesystem::path& path);

}  // namespace lifeline::sources
