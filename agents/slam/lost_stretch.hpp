#pragma once

#include <deque>
#include <span>
#include <vector>

#include "agents/slam/map_tracker.hpp"
#include "agents/slam/motion_model.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/scan_surface.hpp"
#include "common/grid/tsd_update.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline::slam {

struct StretchConfig {
  double view_distance_m = 0.3;  ///< a scan is kept as a view when the head moved this far ...
  double view_turn_rad = 0.3;    ///< ... or turned this much
  std::size_t max_views = 16;
  int max_rejected = 3;         ///< scans in a row; then the stretch begins anew
  std::size_t max_tiles = 256;  ///< 4 MB; then it begins anew
  double cloud_spacing_m = 0.1;
  double max_range_m = 20.0;  ///< points further away take no part
};

/// A small map of its own for the time in which a helmet does not know where it is: it tells how
/// the helmet has moved since, and what it has seen on the way. Frame: `stretch`, whose origin is
/// the head at the first scan. Bounded; one owner.
class LostStretch {
 public:
  LostStretch(StretchConfig config, GridGeometry geometry, PushConfig push, MotionConfig motion,
              MapTracker tracker);

  /// Forgets all; the next scan begins a stretch.
  void clear();
  /// One more scan. Whether it fits the ones before; false also for the first.
  bool step(std::span<const SurfacePiece> pieces, const MotionPrior& prior);

  [[nodiscard]] const Pose2& T_stretch_head() const { return motion_.pose(); }
  [[nodiscard]] const TsdGrid& layer() const { return map_.own(); }
  /// Counts the stretches: another one has another frame.
  [[nodiscard]] int number() const { return number_; }
  /// What was seen on the last few metres, in the head frame of now; the newest first.
  [[nodiscard]] std::vector<SurfacePiece> cloud() const;

 private:
  struct View {
    Pose2 T_stretch_head;
    std::vector<SurfacePiece> pieces;
  };

  void begin(std::span<const SurfacePiece> pieces);
  void keep(std::span<const SurfacePiece> pieces);

  StretchConfig config_;
  MotionModel motion_;
  MapTracker tracker_;
  TsdUpdater updater_;
  WorkingMap map_;
  TsdView view_;
  std::deque<View> views_;
  int rejected_ = 0;
  int number_ = 0;
  bool begun_ = false;
};

}  // namespace lifeline::slam
