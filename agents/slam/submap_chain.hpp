#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "agents/slam/keyframe.hpp"
#include "agents/slam/map_tracker.hpp"
#include "agents/slam/pose_graph.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/tsd_update.hpp"

namespace lifeline::slam {

struct SubmapConfig {
  double path_m = 5.0;      ///< a keyframe is matched against the last 5 to 10 m of the path
  double sigma_xy_m = 0.1;  ///< of the tracker's step, as a start
  double sigma_yaw_rad = 0.02;
  double snap_xy_m = 0.03;     ///< from here on the tracker was drawn to something older ...
  double snap_yaw_rad = 0.01;  ///< ... than the submap knows, and the submap is believed
  double noise_xy_m = 0.01;    ///< of a match against a submap, beside what its points say
  double noise_yaw_rad = 0.001;
  double doubtful_xy_m = 0.12;  ///< a step that may be this far off begins new submaps
  double doubtful_yaw_rad = 0.03;
};

/// The surfaces' farthest point from the head.
[[nodiscard]] double reach_of(std::span<const SurfacePiece> pieces);

/// Measures how each keyframe follows the ones before it. The tracker's own step is good as long as
/// its map is: back at an old place, where the map holds the drifted present and the past side by
/// side, it is drawn over to the past, and the step would hide the drift that a closed loop has to
/// spread. So each step is checked against a submap of the last metres alone. Two submaps overlap:
/// the older is matched against, the newer is being drawn.
class SubmapChain {
 public:
  SubmapChain(const SubmapConfig& config, GridGeometry geometry, const MapTracker& tracker);

  /// The edge to keyframe `index`, whose surfaces are `pieces`, from one before; `index` counts
  /// from 1, start() was called with 0. `updater` draws: it remembers nothing of one call in the
  /// next.
  [[nodiscard]] GraphEdge add(std::size_t index, const Keyframe& keyframe,
                              std::span<const SurfacePiece> pieces, TsdUpdater& updater);
  void start(std::span<const SurfacePiece> pieces, TsdUpdater& updater);
  /// No more keyframes will come: frees the submaps.
  void end();

 private:
  /// The map of a stretch of the path, in the frame of its first keyframe.
  struct Submap {
    std::size_t first = 0;
    double path_m = 0.0;  ///< walked since the first
    Pose2 T_first_last;
    std::unique_ptr<WorkingMap> map;
  };

  [[nodiscard]] GraphEdge measure(std::size_t index, const Keyframe& keyframe,
                                  std::span<const SurfacePiece> pieces);
  void begin_submap(std::size_t first);
  void draw(std::span<const SurfacePiece> pieces, TsdUpdater& updater);

  SubmapConfig config_;
  GridGeometry geometry_;
  MapTracker tracker_;
  Submap older_, newer_;
};

}  // namespace lifeline::slam
