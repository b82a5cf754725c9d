#pragma once

#include <span>
#include <vector>

#include "agents/slam/correlative_search.hpp"
#include "agents/slam/direct_matcher.hpp"
#include "agents/slam/slam_types.hpp"
#include "agents/slam/stage_times.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/tsd_view.hpp"

namespace lifeline::slam {

/// When a direct match is believed.
struct TrackerConfig {
  int min_known = 30;         ///< points where the map knows anything
  double accept_share = 0.6;  ///< inliers among them
  double weak_share = 0.4;
  double sure_share = 0.85;       ///< no search where the prediction led to this
  double surprise_sigma_m = 0.1;  ///< how far off a prediction may be that led to nothing sure
  double search_sigma_m = 0.15;   ///< always search where the prediction may be this far off
  double lever_m = 5.0;           ///< what an error in yaw is worth
  double rival_score = 6.0;   ///< places this much less likely (a log-likelihood) are kept in mind
  int max_rivals = 3;         ///< beside the best
  double through_wall = 1.0;  ///< what a point costs that was seen through a wall, against 1 on one
  double rival_doubt = 2.0;   ///< scores are this much less sure than they look
  double apart_m = 0.12;      ///< nearer places are the same one ...
  double apart_rad = 0.03;    ///< ... if they are turned alike
};

/// A place for a scan.
struct ScoredMatch {
  MatchResult match;
  double score = 0.0;  ///< log-likelihood: agreement with the map and nearness to the prediction
};

/// The default way of placing a scan: direct alignment from the prediction and, where the
/// prediction is loose or the result is poor, a correlative search whose best few places are
/// aligned as well.
class MapTracker {
 public:
  MapTracker(TrackerConfig config, DirectConfig direct, SearchConfig search)
      : config_(config), direct_(direct), search_(search) {}

  /// The best place and its rivals, best first; at least one. Where nothing had to be searched, it
  /// is the only one, and not scored.
  [[nodiscard]] std::vector<ScoredMatch> match(const WorkingMap& map, const TsdView& view,
                                               std::span<const SurfacePiece> pieces,
                                               const Prediction& prediction);

  /// Log-likelihood of a place for the scan last matched: agreement with the map, beams that would
  /// pass through walls, nearness to the prediction.
  [[nodiscard]] double score(const TsdView& view, const Pose2& T_map_head,
                             const Prediction& prediction) const;

  /// These tiles of the map have changed.
  void forget(std::span<const TileIndex> tiles) { search_.forget(tiles); }
  void forget_all() { search_.forget_all(); }

  /// Adds what alignment and search take to `times` from now on; nullptr ends it.
  void time_stages(StageTimes* times) { times_ = times; }

 private:
  /// The local alignment, which is enough for most scans.
  [[nodiscard]] MatchResult match_locally(const TsdView& view, std::span<const SurfacePiece> pieces,
                                          const Prediction& prediction);
  struct Place {
    Pose2 T_map_head;
    PoseSource source;
    double fit;
    double score;                 ///< the most it may be, as long as ...
    bool beams_followed = false;  ///< ... what passes through walls is not taken off yet
  };
  [[nodiscard]] Place place_at(const TsdView& view, const Pose2& T_map_head, PoseSource source,
                               const Prediction& prediction) const;
  /// The local match, and what the search finds beside it.
  [[nodiscard]] std::vector<Place> find_places(const WorkingMap& map, const TsdView& view,
                                               std::span<const SurfacePiece> pieces,
                                               const Prediction& prediction, const Pose2& local);
  /// The best first, each a place of its own, none hopeless.
  [[nodiscard]] std::vector<Place> rivals_of(const TsdView& view, const Prediction& prediction,
                                             std::vector<Place> places) const;
  /// What the rivals add to the covariance of one of them.
  [[nodiscard]] Eigen::Matrix3d spread(const std::vector<ScoredMatch>& matches,
                                       const ScoredMatch& about) const;
  /// Of a place where the scan fits so well, `fit` up to 1.
  [[nodiscard]] double log_likelihood(double fit, const Pose2& T_map_head,
                                      const Prediction& prediction) const;
  /// Takes what passes through walls off the place's score. Where less than `least` is left, it
  /// need not be known how much.
  void follow_beams(const TsdView& view, const Prediction& prediction, double least,
                    Place& place) const;
  [[nodiscard]] MatchResult judged(const TsdView& view, const Pose2& T_map_head, PoseSource source,
                                   const Prediction& prediction) const;
  [[nodiscard]] bool needs_search(const MatchResult& local, const Prediction& prediction) const;

  TrackerConfig config_;
  DirectMatcher direct_;
  CorrelativeSearch search_;
  StageTimes* times_ = nullptr;
};

}  // namespace lifeline::slam
