#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/result.hpp"
#include "common/files/canvas.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace lifeline::files {

/// Where somebody went, in the map's frame (m). Points that are not finite are left out.
struct PicturePath {
  std::string name;
  std::vector<Eigen::Vector2d> points;
  /// Which of the colours, so that somebody has the same one on every picture; by default the place
  /// in the list.
  std::optional<std::size_t> colour = {};
};

/// Draws a map for people (PNG, or any other format): explored floor, walls, the unknown hatched,
/// each path in a colour that colour-blind people tell apart (Okabe and Ito) from a ring at its
/// start to a disc with its name at its end, a legend and a scale bar. x goes right, y up. The
/// sides are 400 to 4000 pixels; large maps are drawn with several cells to a pixel, of which a
/// wall always shows.
[[nodiscard]] Result<void> write_map_picture(const std::filesystem::path& file,
                                             const OccupancyGrid& grid,
                                             const std::vector<PicturePath>& paths,
                                             const std::string& title,
                                             DrawingFormat format = DrawingFormat::png);

/// A part of a canvas.
struct PictureFrame {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};
/// The same drawing as large as it fits into a part of a canvas, from its upper left corner. The
/// height it takes there.
double draw_map_picture(Canvas& canvas, const PictureFrame& frame, const OccupancyGrid& grid,
                        const std::vector<PicturePath>& paths, const std::string& title);

}  // namespace lifeline::files
