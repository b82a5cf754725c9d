#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/grid/stamped_pose.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::files {

/// One helmet's map as it stands in a NAME.lifemap file.
struct SavedMap {
  LayerKey layer;
  TsdGrid grid;
  std::vector<StampedPose> trajectory;  ///< T_map_head
};

/// Saves a layer and its trajectory whole or not at all. Cells are kept at the published precision
/// (QuantisedCell), tiles in the encoding of the wire.
[[nodiscard]] Result<void> save_map(const std::filesystem::path& file, const LayerKey& layer,
                                    const TsdGrid& grid, std::span<const StampedPose> trajectory);

/// Loads a saved map. The file may come from anywhere: its size, its tiles and its poses are
/// limited before memory is taken for them, and every tile and pose is checked.
[[nodiscard]] Result<SavedMap> load_map(const std::filesystem::path& file);

}  // namespace lifeline::files
