#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/plan.hpp"
#include "common/base/result.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::bench {

/// One map as a small picture, in the building's frame.
struct Panel {
  std::string title;
  const TsdGrid* map = nullptr;
  Pose2 T_world_map;
  std::vector<std::vector<Eigen::Vector2d>> paths = {};  ///< world frame
};

/// Draws maps side by side, `columns` in a row, with the plan's walls over each as thin red lines:
/// where black stands beside red, the map is wrong.
[[nodiscard]] Result<void> draw_panels(const std::filesystem::path& file,
                                       const sources::FloorPlan& plan,
                                       const std::vector<Panel>& panels, int columns);

}  // namespace lifeline::bench
