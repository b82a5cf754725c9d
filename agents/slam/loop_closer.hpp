#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "agents/slam/keyframe.hpp"
#include "agents/slam/map_tracker.hpp"
#include "agents/slam/pose_graph.hpp"
#include "agents/slam/submap_chain.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/tsd_update.hpp"

namespace lifeline::slam {

struct LoopConfig {
  double min_path_m = 10.0;     ///< walked since a place before coming back to it counts
  double near_m = 6.0;          ///< an old keyframe this near is a place one came back to
  double turn_worth_m = 2.0;    ///< one that looked the other way counts as this much further away
  double attempt_path_m = 1.0;  ///< walked from attempt to attempt
  double old_reach_m = 5.0;  ///< of path, either side of the old keyframe: what is matched against
  double new_reach_m = 2.5;  ///< of path before the new keyframe: what is matched

  double sigma_xy_m = 0.05;  ///< between places seen one after the other ...
  double sigma_yaw_rad = 0.01;
  double drift_xy = 0.012;  ///< ... and how it grows with each metre of path
  double drift_yaw_rad_m = 0.0006;
  double max_sigma_xy_m = 0.7;
  double max_sigma_yaw_rad = 0.15;
  double lost_xy_m = 0.35;  ///< steps less sure than this add to it
  double lost_yaw_rad = 0.05;

  double accept_share = 0.85;  ///< inliers among the points where the old map knows anything
  int min_known = 60;
  double min_known_share = 0.6;         ///< of the points, where the old map knows anything ...
  double min_known_share_ahead = 0.45;  ///< ... of a lidar that does not look behind
  double min_margin = 8.0;              ///< log-likelihood between the best place and the next
  double noise_xy_m = 0.02;             ///< of a closed loop, beside what its points say
  double noise_yaw_rad = 0.003;
  double surprise_xy_m = 0.3;      ///< a loop that moves more than this ...
  double surprise_yaw_rad = 0.05;  ///< ... or turns more waits for a second one that agrees
  double surprise_path_m = 5.0;    ///< within this path
  double agree_xy_m = 0.2;
  double agree_yaw_rad = 0.03;

  double redraw_xy_m = 0.06;  ///< corrections below this leave the layer as it is
  double redraw_yaw_rad = 0.008;
  int tie_rounds = 2;       ///< at the end, how often all places seen twice are measured again
  double tie_path_m = 1.0;  ///< of path from one to the next
  double tie_sigma_xy_m = 0.1;
  double tie_sigma_yaw_rad = 0.02;
  double doubtful_share = 0.85;  ///< fewer inliers than this, or a doubtful step: looked at again
  double doubtful_sigma_xy_m = 0.3;  ///< (of the search for a better place, at least)
  double doubtful_reach_m = 8.0;     ///< on a map of the others within this distance
  double doubtful_margin = 3.0;      ///< and moves to a place this much likelier
  double polish_sigma_xy_m = 0.03;   ///< of a keyframe against the layer drawn anew
  double polish_sigma_yaw_rad = 0.006;
  double polish_max_m = 0.1;
  GraphConfig graph;
  SubmapConfig submaps;
};

/// Closes loops: notices when the helmet comes back to a place, measures where it is by matching
/// its last scans against a map of that place drawn from the old scans alone, spreads the
/// contradiction over the path between (a graph of poses) and draws the layer anew. A loop that
/// would move much has to be confirmed by a second one. Deterministic. One owner.
class LoopCloser {
 public:
  LoopCloser(const LoopConfig& config, GridGeometry geometry, const PushConfig& push,
             const TrackerConfig& tracker, const DirectConfig& direct, const SearchConfig& search);

  /// Takes the next keyframe (their indices are consecutive, from 0). Looks for a loop if one is
  /// due; whether the past has moved: then correction() tells how.
  [[nodiscard]] bool take(Keyframe keyframe);
  [[nodiscard]] MapCorrection correction();
  /// The correction that is due when no more keyframes come: all that is known, and each keyframe
  /// aligned once more with the whole. None where nothing is to be corrected.
  [[nodiscard]] std::optional<MapCorrection> finish();

  /// Whether there was a correction before: then finish() has one more.
  [[nodiscard]] bool has_corrected() const { return redrawn_; }
  [[nodiscard]] std::size_t keyframes() const { return keyframes_.size(); }

  [[nodiscard]] std::size_t loops() const { return loops_; }

 private:
  void append(const Keyframe& keyframe);
  [[nodiscard]] std::optional<std::size_t> old_place(std::size_t now) const;
  [[nodiscard]] std::optional<GraphEdge> measure(std::size_t old_index, std::size_t now,
                                                 const Prediction& prediction);
  void draw_place(std::size_t old_index, std::size_t now);
  [[nodiscard]] std::vector<SurfacePiece> surface_before(std::size_t now) const;
  [[nodiscard]] Prediction predict(std::size_t old_index) const;
  [[nodiscard]] bool believe(const GraphEdge& edge);
  [[nodiscard]] bool is_surprising(const GraphEdge& edge) const;
  [[nodiscard]] bool confirms(const GraphEdge& edge, const GraphEdge& surprise) const;
  void close(const GraphEdge& edge);
  [[nodiscard]] bool has_moved() const;
  [[nodiscard]] TsdGrid drawn_layer();
  /// The same as the place to match against.
  void draw_all();
  void tie_places();
  /// Moves keyframes that fit better elsewhere; how many did.
  int reconsider();
  [[nodiscard]] bool is_doubtful(std::size_t index);
  void draw_others(std::size_t index);
  void polish();
  /// The keyframe's surfaces, until the next call.
  [[nodiscard]] const std::vector<SurfacePiece>& unpacked(std::size_t index);

  LoopConfig config_;
  TsdUpdater updater_;
  MapTracker tracker_;
  DirectMatcher direct_;
  SubmapChain chain_;
  WorkingMap place_;  ///< of old scans, in the map frame
  std::vector<Keyframe> keyframes_;
  std::vector<double> path_m_;      ///< walked up to each keyframe
  std::vector<Pose2> poses_;        ///< T_map_head, as optimised
  std::vector<Pose2> drawn_poses_;  ///< as the layer has them
  std::vector<GraphEdge> edges_;
  std::optional<GraphEdge> surprise_;  ///< waits for a second opinion
  double next_attempt_m_ = 0.0;
  double closed_at_m_ = 0.0;                        ///< path when the last loop was closed
  Eigen::Matrix3d lost_ = Eigen::Matrix3d::Zero();  ///< covariance of the lost steps since then
  bool redrawn_ = false;
  std::size_t loops_ = 0;
  std::vector<SurfacePiece> scratch_;
};

}  // namespace lifeline::slam
