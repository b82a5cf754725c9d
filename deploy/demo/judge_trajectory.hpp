#pragma once

#include <filesystem>
#include <optional>

#include "common/grid/pose2.hpp"

namespace lifeline::demo {

/// How a helmet's trajectory compares with the truth; nothing where either is unknown.
struct TrajectoryVerdict {
  std::optional<double> rmse_m;      ///< of the positions, after the best rigid alignment
  std::optional<Pose2> T_world_map;  ///< where the map frame truly lies
};

/// Compares two TUM files. The map frame's true place is that of the best rigid alignment of the
/// whole trajectory: a recorded log's single true poses are good to a few degrees only. A file that
/// is not there or cannot be read leaves the verdict empty.
[[nodiscard]] TrajectoryVerdict judge_trajectory(const std::filesystem::path& estimate,
                                                 const std::filesystem::path& truth);

}  // namespace lifeline::demo
