#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/packed_surface.hpp"
#include "common/base/time.hpp"
#include "common/grid/pose2.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::slam {

/// Keyframes are numbered from 0 in the order of their scans.
using KeyframeIndex = std::uint32_t;

/// A scan that was pushed and is kept, so that the layer can be drawn anew when the past is
/// corrected.
struct Keyframe {
  KeyframeIndex index = 0;
  Timestamp stamp{};
  Pose2 T_map_head;       ///< as it was pushed
  Pose2 T_previous_this;  ///< the step from the keyframe before; corrections do not change it
  /// Of that step, in the frame of the keyframe before: x, y (m), yaw (rad).
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  PackedSurface surface;
};

/// The past, corrected: where the keyframes really were, and the layer drawn from them anew.
struct MapCorrection {
  std::vector<Pose2> T_map_head;  ///< of the keyframes 0 ... size - 1
  TsdGrid layer;
};

}  // namespace lifeline::slam
