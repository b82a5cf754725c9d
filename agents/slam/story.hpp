#pragma once

#include <vector>

#include "agents/slam/motion_model.hpp"
#include "agents/slam/slam_types.hpp"
#include "agents/slam/walk_filter.hpp"
#include "common/grid/scan2.hpp"
#include "common/grid/scan_surface.hpp"

namespace lifeline::slam {

struct StoryConfig {
  int max_stories = 4;
  int max_unsettled = 4;        ///< scans; the oldest is then settled by the best story
  double hopeless = 8.0;        ///< a story this much less likely than the best is given up
  double same_place_m = 0.1;    ///< stories that end nearer to each other are one ...
  double same_turn_rad = 0.03;  ///< ... if they look the same way
};

/// A scan whose place more than one story tells.
struct UnsettledScan {
  Scan2 scan;
  std::vector<SurfacePiece> pieces;  ///< of the scan
  double reach_m = 0.0;              ///< of its farthest hit
  /// Only a walker's usual motion leads here: no odometry, no keyframe's leap.
  bool is_walked = false;
};

/// A scan's place in one story.
struct StoryStep {
  MatchResult match;
  Prediction prediction;
  PositionFix fix;
};

/// One account of where the unsettled scans were taken: in a corridor of equal doors, a scan may
/// fit one door further as well, and only the next scans tell.
struct Story {
  MotionModel motion;
  double score = 0.0;  ///< log-likelihood of its unsettled scans
  std::vector<StoryStep> steps;
};

/// Orders the stories, best first, and drops the hopeless ones and those that end like a better
/// one.
void keep_likely(std::vector<Story>& stories, const StoryConfig& config);

/// Whether all tell the same of the oldest unsettled scan.
[[nodiscard]] bool agree_on_oldest(const std::vector<Story>& stories);

/// Drops the stories that tell the oldest unsettled scan otherwise than the best, then the scan.
void settle_oldest(std::vector<Story>& stories);

}  // namespace lifeline::slam
