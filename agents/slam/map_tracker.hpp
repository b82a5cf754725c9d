#pragma once

#include <span>
#include <vector>

#include "agents/slam/correlative_search.hpp"
#include "agents/slam/direct_matcher.hpp"
#include "agents/slam/slam_types.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline::slam {

/// When a direct match is believed.
struct TrackerConfig {
  int min_known = 30;         ///< points where the map knows anything
  double accept_share = 0.6;  ///< inliers among them
  double weak_share = 0.4;
  double sure_share = 0.85;      ///< no search where the prediction led to this
  double search_sigma_m = 0.15;  ///< always search where the prediction may be this far off
  double lever_m = 5.0;          ///< what an error in yaw is worth
};

/// The default way of placing a scan: direct alignment from the prediction and, where the
/// prediction is loose or the result is poor, a correlative search whose best few places are
/// aligned as well.
class MapTracker {
 public:
  MapTracker(TrackerConfig config, DirectConfig direct, SearchConfig search)
      : config_(config), direct_(direct), search_(search) {}

  [[nodiscard]] MatchResult match(const WorkingMap& map, const TsdView& view,
                                  std::span<const SurfacePiece> pieces,
                                  const Prediction& prediction);

  /// These tiles of the map have changed.
  void forget(std::span<const TileIndex> tiles) { search_.forget(tiles); }
  void forget_all() { search_.forget_all(); }

 private:
  [[nodiscard]] MatchResult judged(const TsdView& view, const Pose2& T_map_head, PoseSource source,
                                   const Prediction& prediction) const;
  [[nodiscard]] bool needs_search(const MatchResult& local, const Prediction& prediction) const;
  [[nodiscard]] double score(const TsdView& view, const Pose2& T_map_head,
                             const Prediction& prediction) const;

  TrackerConfig config_;
  DirectMatcher direct_;
  CorrelativeSearch search_;
};

}  // namespace lifeline::slam
