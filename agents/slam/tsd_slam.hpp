#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "agents/slam/failure_detector.hpp"
#include "agents/slam/gicp_matcher.hpp"
#include "agents/slam/keyframe_log.hpp"
#include "agents/slam/loop_closer.hpp"
#include "agents/slam/map_tracker.hpp"
#include "agents/slam/model_matcher.hpp"
#include "agents/slam/motion_model.hpp"
#include "agents/slam/path_smoother.hpp"
#include "agents/slam/relocaliser.hpp"
#include "agents/slam/slam_types.hpp"
#include "agents/slam/stage_times.hpp"
#include "agents/slam/story.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/stamped_pose.hpp"
#include "common/grid/tsd_update.hpp"

namespace lifeline::slam {

enum class Matcher {
  conventional,  ///< the paper's: ray-cast model, RANSAC, ICP, no failure detection
  advanced,      ///< the paper's: the same with Algorithm 1 and GICP scan to scan
  direct,        ///< ours: direct alignment and search, GICP scan to scan where that fails
};

/// The SlamConfig of idl/config.proto as plain values, with what users need not tune beside it.
struct SlamConfig {
  Matcher matcher = Matcher::direct;
  double max_range_m = 30.0;
  int min_model_points = 20;       ///< n_min of Algorithm 1
  double max_mean_error_m = 0.08;  ///< E_TF0 of Algorithm 1, as a mean
  int gicp_max_iterations = 100;

  SurfaceConfig surface;
  PushConfig push;
  MotionConfig motion;
  TrackerConfig tracker;
  DirectConfig direct;
  SearchConfig search;
  RansacConfig ransac;
  IcpConfig icp;
  double push_distance_m = 0.05;  ///< a scan is pushed when the head moved this far ...
  double push_turn_rad = 0.03;    ///< ... or turned this much ...
  double push_interval_s = 0.05;  ///< ... or this time went by since the last push
  double dense_interval_s = 0.3;  ///< pushes closer together than this are dense looks
  KeyframeConfig keyframes;
  LoopConfig loops;
  StoryConfig stories;
  int lost_after_scans = 3;  ///< that nothing matched, in a row, before the helmet counts as lost
  double walked_m_s = 1.0;   ///< that a helmet may have moved unseen, one standard deviation ...
  double fastest_m_s = 2.0;  ///< ... and at the most
  double recovered_sigma_m = 0.1;  ///< after so many, a place less sure is not pushed at
  RelocaliseConfig relocalise;
};

/// Where a helmet was before a restart.
struct LastPlace {
  Pose2 T_map_head;
  Duration ago{};
};

/// What one scan did.
struct SlamStep {
  Pose2 T_map_head;
  MatchEvidence evidence;
  Verdict verdict = Verdict::rejected;
  PoseSource source = PoseSource::dead_reckoning;
  int pushed = 0;         ///< scans that entered the layer: this one, or older ones settled by it
  int trust_percent = 0;  ///< how far the pose can be relied on; falls while nothing matches
  int stories = 1;        ///< places that are still possible; the pose is the likeliest
  bool lost = false;      ///< the place in the map is not known: the pose is a guess
};

/// One helmet's SLAM (paper, section 2). Frame: `map`, whose origin is the first pose. One owner.
class TsdSlam {
 public:
  TsdSlam(SlamConfig config, GridGeometry geometry);

  /// Places the scan, and pushes it if it was placed well. A scan that is doubtful by itself
  /// (ScanCheck) is placed like any other, but lowers the trust.
  [[nodiscard]] SlamStep step(const Scan2& scan, const MotionPrior& prior,
                              bool is_doubtful = false);
  /// Goes on in a map made before, of this geometry: lost, until the first scans are found in it.
  /// `last`: where the helmet was known to be moments ago, if it was. If those are so few that the
  /// search round that place reaches far enough, they are a short blindness. Before the first
  /// step().
  void resume(TsdGrid layer, std::optional<LastPlace> last = {});
  /// Lost: nothing matched for so long that the place may be anywhere. Nothing is pushed until it
  /// is found again, and the trust is 0.
  [[nodiscard]] bool is_lost() const { return lost_; }

  /// The own layer: own observations only, whatever the peers say.
  [[nodiscard]] const TsdGrid& layer() const { return map_.own(); }
  /// What scans are matched against.
  [[nodiscard]] const WorkingMap& working_map() const { return map_; }
  /// The layer's tiles changed since the last call, ordered.
  [[nodiscard]] std::vector<TileIndex> take_changed_tiles();

  /// Where the scans from number `first` on were taken, by all that is known now: all but the last
  /// few.
  [[nodiscard]] std::vector<StampedPose> trajectory(std::size_t first = 0) const;
  /// Settles the last few by what is known: no more scans will come.
  void settle_all();
  /// Looks once more for a place for the scans that found none, now that the map holds what came
  /// after them. How many found one.
  int revisit();
  /// Where a scan saw little along some direction, moves its place to where the scans before and
  /// after say that the head went. Once, after the last scan; layer and keyframes stay.
  void smooth_trajectory();
  /// The keyframes since the last call, in order.
  [[nodiscard]] std::vector<Keyframe> take_keyframes() { return keyframes_.take(); }
  /// Takes over a corrected past: the layer as drawn anew, the scans since then on top, the present
  /// moved along. False, and nothing done, where the correction is too old.
  bool apply(MapCorrection correction);
  /// The same where the correction, which will know the first `keyframes` keyframes, is yet to be
  /// worked out: the old layer is given up before, so that there are never two.
  bool apply(std::size_t keyframes, const std::function<MapCorrection()>& work_out);

  /// Peers' cells in this map's frame (Eq. 8-10); nullptr takes a tile away.
  void set_peer_tile(TileIndex tile, std::shared_ptr<const TsdTile> cells);
  void clear_peers();
  void set_own_weight(double w_T1);

  /// Adds what the stages take to `times` from now on; nullptr ends it.
  void time_stages(StageTimes* times);

 private:
  /// A scan's place, held to the keyframe before it: a correction moves both.
  struct SettledScan {
    Timestamp stamp{};
    std::size_t keyframes = 0;  ///< so many were kept up to here
    Pose2 T_keyframe_head;  ///< from the last of them; from the map's origin, where there is none
    PositionFix fix;        ///< in the map as it was when the scan was settled
  };

  void take_in(const Scan2& raw, const MotionPrior& prior);
  /// A scan that found no sure place when it came.
  struct UnplacedScan {
    std::size_t settled = 0;  ///< its number among the settled scans
    double sigma_xy_m = 0.0;  ///< of the place it was given instead
    double sigma_yaw_rad = 0.0;
    PackedSurface surface;
  };

  [[nodiscard]] SlamStep start();
  void recover(MatchResult& match, MotionModel& motion) const;
  void note_match(const MotionPrior& prior);
  [[nodiscard]] SlamStep step_lost(const MotionPrior& prior);
  void bridge_gap(const MotionPrior& prior);
  void look_round(const Pose2& T_map_head, Duration unseen, double sigma_yaw_rad);
  void reckon(const MotionPrior& prior, const std::optional<Pose2>& T_previous_now);
  void add_heading_doubt(const MotionPrior& prior);
  void extend(const Story& story, const MotionPrior& prior, std::vector<Story>& longer);
  [[nodiscard]] PositionFix fix_of(const MatchResult& match, const Prediction& prediction,
                                   const MotionModel& motion, const MotionPrior& prior) const;
  [[nodiscard]] std::vector<ScoredMatch> place(const Prediction& prediction, const Story& story,
                                               const Pose2& predicted_step);
  [[nodiscard]] MatchResult match_by_model(const Prediction& prediction, const Story& story) const;
  [[nodiscard]] MatchResult match_previous_scan(const Prediction& prediction,
                                                const Pose2& last_pose,
                                                const Pose2& predicted_step) const;
  int settle(std::size_t most_unsettled);
  [[nodiscard]] Pose2 pose_of(const SettledScan& scan) const;
  [[nodiscard]] bool settle_scan(const UnsettledScan& scan, const StoryStep& step);
  void note_settled(Timestamp stamp, const Pose2& T_map_head, const PositionFix& fix);
  [[nodiscard]] double since_push_s(Timestamp stamp) const;
  [[nodiscard]] bool push_is_due(const Pose2& T_map_head, Timestamp stamp) const;
  void push(std::span<const SurfacePiece> pieces, const Pose2& T_map_head, Timestamp stamp);
  void change_trust(Verdict verdict);

  SlamConfig config_;
  WorkingMap map_;
  ModelMatcher model_matcher_;
  MapTracker tracker_;
  GicpMatcher gicp_;
  FailureDetector detector_;
  Relocaliser relocaliser_;
  TsdUpdater updater_;
  TsdView view_;
  KeyframeLog keyframes_;
  std::vector<Story> stories_;                 ///< best first; never empty
  std::vector<UnsettledScan> unsettled_;       ///< oldest first
  std::vector<SurfacePiece> previous_pieces_;  ///< D_(k-1)
  std::vector<SettledScan> settled_;
  std::vector<UnplacedScan> unplaced_;
  std::set<TileIndex> changed_;
  StageTimes* times_ = nullptr;
  bool started_ = false;
  bool lost_ = false;
  std::optional<Whereabouts> last_;  ///< while nothing was matched since resume()
  bool resumed_ = false;             ///< the layer holds what no keyframe knows of
  /// After scans that nothing matched: a match that leaves the place open does not end it.
  bool recovering_ = false;
  int rejected_in_a_row_ = 0;
  double heading_variance_ = 0.0;  ///< of the yaw since the last scan that matched, rad^2
  int trust_percent_ = 0;
  Pose2 pushed_at_;
  Timestamp pushed_stamp_{};
};

}  // namespace lifeline::slam
