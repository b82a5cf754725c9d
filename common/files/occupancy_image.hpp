#pragma once

#include <filesystem>

#include "common/base/result.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace lifeline::files {

/// Writes NAME.pgm and NAME.yaml as ROS map_server does: 254 free, 0 occupied, 205 unknown, mode
/// trinary with thresholds 0.65 and 0.196. `name` has no extension; dots in it stay.
[[nodiscard]] Result<void> write_occupancy_image(const std::filesystem::path& name,
                                                 const OccupancyGrid& grid);

/// Reads a map of ROS map_server by its YAML file; the image (PGM or PNG) is looked up beside it.
/// Modes trinary and scale; a scale's steps between free and occupied become unknown, and so does,
/// in that mode, what is not opaque. A turned origin, mode raw and anything malformed is refused
/// with FILE:LINE:COLUMN.
[[nodiscard]] Result<OccupancyGrid> read_occupancy_image(const std::filesystem::path& yaml_file);

}  // namespace lifeline::files
