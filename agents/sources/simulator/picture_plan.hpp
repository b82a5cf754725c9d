#pragma once

#include <filesystem>
#include <string>

#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"
#include "common/files/grey_image.hpp"

namespace lifeline::sources {

inline constexpr double kPictureCellM = 0.05;  ///< side of a pixel
inline constexpr int kPictureFree = 250;       ///< this bright and brighter is floor

/// The plan drawn by a picture: pixels of at least kPictureFree are floor, everything else and all
/// beyond the picture is solid; what is not opaque counts as white behind. Walls are the borders
/// between them, exactly along the pixels' edges, the floor to their left. The lower left corner of
/// the picture is the world's origin, y goes up. `name` stands in messages. bad_data for a picture
/// without floor, or larger than kMaxPlanSideM or kMaxWallsM.
[[nodiscard]] Result<FloorPlan> plan_from_picture(const files::GreyImage& picture,
                                                  const std::string& name);

/// The same from a PNG file.
[[nodiscard]] Result<FloorPlan> read_picture_plan(const std::filesystem::path& file);

}  // namespace lifeline::sources
