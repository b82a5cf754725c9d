#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agents/slam/direct_matcher.hpp"
#include "agents/slam/global_search.hpp"
#include "agents/slam/lost_stretch.hpp"
#include "agents/slam/working_map.hpp"

namespace lifeline::slam {

/// What the points seen must say at a place that is believed.
struct PlaceDemands {
  double min_known_share = 0.0;     ///< of the points, where the map knows anything
  double max_conflict_share = 0.0;  ///< of these, in space the map knows as free
};

/// When a place is believed. The defaults are meant to be wrong in none of some hundred thousand
/// cases rather than quick (docs/decisions/0207).
struct RelocaliseConfig {
  GlobalSearchConfig search;
  StretchConfig stretch;
  PlaceDemands anywhere{.min_known_share = 0.7, .max_conflict_share = 0.04};
  double min_inlier_share = 0.85;   ///< of the points that the map knows
  double max_gone_share = 0.08;     ///< of the map's walls here: space seen free now
  double margin = 0.15;             ///< in quality, to the second distinct place
  int attempts = 3;                 ///< in a row that must agree ...
  double moved_m = 2.0;             ///< ... over a way this long
  double same_m = 0.2;              ///< they agree up to this ...
  double same_rad = 0.06;           ///< ... and this
  double attempt_distance_m = 0.1;  ///< between attempts, or ...
  int attempt_scans = 5;            ///< ... so many scans
  double heading_sigmas = 3.0;      ///< that the heading may be off ...
  double heading_floor_rad = 0.15;  ///< ... and this beside
  double stayed_m = 1.0;  ///< a helmet found this near to where it was last known needs no way
  // Of a helmet that was known moments ago, in what it can have reached since, if that is not far:
  double near_most_m = 15.0;
  PlaceDemands near{.min_known_share = 0.45, .max_conflict_share = 0.02};
  double near_agreement = 0.35;  ///< that a place must have to be looked at
  double near_moved_m = 0.5;     ///< way over which the attempts agree
  int near_scans = 100;          ///< after these where it was last is no evidence any more
  /// Of the search, for one scan: a longer one goes on with the next scans.
  SearchWork work_per_scan = 8'000'000;
};

/// Where a helmet was known to be moments ago.
struct Whereabouts {
  Pose2 T_map_head;
  double reach_m = 0.0;  ///< no further from there can it be now
};

/// A place looked at closely.
struct RelocalisedPlace {
  Pose2 T_map_head;
  MatchEvidence evidence;
  double gone_share = 0.0;  ///< of the map's walls around: seen through
  double quality = 0.0;     ///< agreement of the points less gone_share
};

/// What one attempt came to.
enum class AttemptOutcome {
  nothing,    ///< no place is good enough
  ambiguous,  ///< more than one may be
  agreed,     ///< one place stands out; not yet often enough
  found,
};

/// Finds a helmet's place again in its working map, wherever it is. Follows the helmet on a stretch
/// of its own (LostStretch), searches the whole map for what was seen on it, looks at the best
/// places closely, and believes one only if nothing speaks against it, no other comes near it, and
/// several attempts over some way agree. A search that takes longer than one scan may goes on with
/// the next; what it finds is moved along with the head (docs/decisions/0212). One owner.
class Relocaliser {
 public:
  Relocaliser(RelocaliseConfig config, GridGeometry geometry, PushConfig push, MotionConfig motion,
              MapTracker tracker, DirectConfig direct);

  /// Begins anew, with the map as it is now. `last`: where the helmet was known to be moments ago,
  /// if it was. Places in its reach come first: neither do equal places further off count, nor need
  /// the map know so much of what is seen there, and a shorter way is enough; none where the helmet
  /// has stayed, for who stands still while the helmet restarts must be found, too.
  void begin(std::optional<Whereabouts> last = {});
  /// The map has changed, by peers' tiles.
  void map_changed() { map_is_stale_ = true; }
  /// Frees what is not needed while tracking.
  void end();

  /// One more scan. How the head moved with it; empty where it does not fit the scans before.
  [[nodiscard]] std::optional<Pose2> follow(std::span<const SurfacePiece> pieces,
                                            const MotionPrior& prior);
  /// Looks for the place, after a follow() that knew the motion, if it is time to. The place, once
  /// it is sure. `heading_rad` in map, +- `heading_sigma_rad`.
  [[nodiscard]] std::optional<RelocalisedPlace> look(const WorkingMap& map, double heading_rad,
                                                     double heading_sigma_rad);

  [[nodiscard]] AttemptOutcome last_outcome() const { return outcome_; }

 private:
  /// One attempt, from when it begins until its searches are done.
  struct Attempt {
    int stretch = 0;
    int scan = 0;  ///< when it began, as all that follows
    Pose2 T_stretch_head;
    double heading_rad = 0.0;
    double window_rad = 0.0;
    std::vector<Eigen::Vector2d> points;
    bool has_map = false;
    std::optional<SearchCircle> near;  ///< where is searched; in the whole map, if empty
    bool searches = false;
  };
  [[nodiscard]] bool attempt_is_due();
  void begin_attempt(double heading_rad, double heading_sigma_rad);
  /// Goes on with the attempt; what it came to, once it is done.
  [[nodiscard]] std::optional<AttemptOutcome> go_on(const WorkingMap& map, RelocalisedPlace& best);
  [[nodiscard]] bool search(const WorkingMap& map, SearchWork& work);
  void take_cloud();
  /// The best of the places that the search found, as seen from where the head is now.
  [[nodiscard]] AttemptOutcome look_at_found(const WorkingMap& map, RelocalisedPlace& best);
  [[nodiscard]] RelocalisedPlace look_at(const WorkingMap& map, const Pose2& T_map_head,
                                         double reach_m);
  void note_seen();
  [[nodiscard]] double gone_share(const Pose2& T_map_head) const;
  [[nodiscard]] bool is_good(const RelocalisedPlace& place, const PlaceDemands& demands) const;
  /// No other of the places comes near it in quality.
  [[nodiscard]] bool is_alone(const RelocalisedPlace& place,
                              const std::vector<RelocalisedPlace>& places) const;
  [[nodiscard]] AttemptOutcome judge(std::vector<RelocalisedPlace> places, bool complete,
                                     const PlaceDemands& demands, RelocalisedPlace& best) const;
  /// How far a helmet that is here now was from where it was last known, when its stretch began.
  [[nodiscard]] double from_last_m(const Pose2& T_map_head) const;
  [[nodiscard]] bool is_last_known() const;
  [[nodiscard]] bool is_near() const;
  [[nodiscard]] double way_needed_m(const Pose2& T_map_head) const;
  [[nodiscard]] bool agrees(const Pose2& T_map_head);

  RelocaliseConfig config_;
  GlobalSearch search_;
  LostStretch stretch_;
  DirectMatcher direct_;
  TsdView view_;
  bool map_is_stale_ = true;
  int scans_since_attempt_ = 0;
  Pose2 T_stretch_attempt_;
  int attempt_stretch_ = 0;
  std::optional<Whereabouts> last_;
  int scans_since_last_ = 0;
  int near_in_vain_ = 0;  ///< attempts that found nothing there
  int last_stretch_ = 0;  ///< the stretch that began there
  std::optional<Attempt> attempt_;
  std::vector<SurfacePiece> cloud_;
  /// A cell of the stretch that tells of the map's walls: free now, or a wall.
  struct SeenCell {
    CellIndex index;
    bool is_free;
  };
  std::vector<SeenCell> seen_;
  /// What the attempts so far agree on.
  struct Agreement {
    int attempts = 0;
    int stretch = 0;
    Pose2 T_map_stretch;
    Pose2 T_stretch_first;  ///< the head, at the first attempt
  } agreement_;
  AttemptOutcome outcome_ = AttemptOutcome::nothing;
};

}  // namespace lifeline::slam
