// What TsdSlam does when nothing matches: recovers from a short blindness, or is lost and looks for
// its place (docs/decisions/0207).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "agents/slam/tsd_slam.hpp"
#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {

/// A search that reaches so far is worth it: who stood farther off is looked for as lost.
constexpr double kReachedSigmas = 1.5;

}  // namespace

void TsdSlam::recover(MatchResult& match, MotionModel& motion) const {
  motion.found(match.T_map_head, match.evidence.covariance.topLeftCorner<2, 2>());
  if (match.evidence.weakest_sigma_m <= config_.recovered_sigma_m) return;
  // Along a corridor, say: used, but not pushed, and looked for as widely as before.
  match.verdict = Verdict::weak;
  motion.doubt(match.evidence.weakest_sigma_m);
}

void TsdSlam::note_match(const MotionPrior& prior) {
  const StoryStep& last = stories_.front().steps.back();
  if (std::any_of(stories_.begin(), stories_.end(), [](const Story& story) {
        return story.steps.back().match.verdict != Verdict::rejected;
      })) {
    rejected_in_a_row_ = 0;
    heading_variance_ = 0.0;
    last_.reset();
    recovering_ = recovering_ && last.match.verdict != Verdict::accepted;
    return;
  }
  ++rejected_in_a_row_;
  if (last_) last_->reach_m += config_.fastest_m_s * to_seconds(prior.elapsed);
  recovering_ = recovering_ || rejected_in_a_row_ >= config_.lost_after_scans;
  add_heading_doubt(prior);
  const SearchConfig& search = config_.search;
  // Steps of yaw add up in the prediction; an attitude sensor's errors do not.
  const double sigma_yaw_rad =
      std::min(last.prediction.sigma_yaw_rad, std::sqrt(heading_variance_));
  const bool beyond_search =
      search.window_sigmas * last.prediction.largest_sigma_m() > search.max_window_m ||
      search.window_sigmas * sigma_yaw_rad > search.max_window_rad;
  if (!beyond_search || rejected_in_a_row_ < config_.lost_after_scans) return;
  lost_ = true;
  stories_.erase(stories_.begin() + 1, stories_.end());
  trust_percent_ = 0;
  relocaliser_.begin(last_);
}

void TsdSlam::add_heading_doubt(const MotionPrior& prior) {
  double sigma_rad = std::numbers::pi;  // any heading at all
  if (prior.yaw_step_rad) {
    sigma_rad = config_.motion.attitude_yaw_rad;
  } else if (prior.T_previous_now) {
    sigma_rad = config_.motion.odometry_yaw_rad +
                config_.motion.odometry_share * std::abs(prior.T_previous_now->yaw_rad);
  }
  heading_variance_ += sigma_rad * sigma_rad;
}

SlamStep TsdSlam::step_lost(const MotionPrior& prior) {
  const StageTimer timer(times_ == nullptr ? nullptr : &times_->relocalise);
  const UnsettledScan scan = std::move(unsettled_.back());
  unsettled_.clear();
  const auto T_previous_now = relocaliser_.follow(scan.pieces, prior);
  reckon(prior, T_previous_now);
  MotionModel& motion = stories_.front().motion;
  SlamStep step;
  step.lost = true;
  step.evidence.points = static_cast<int>(scan.pieces.size());
  std::optional<RelocalisedPlace> place;
  if (T_previous_now) {
    place = relocaliser_.look(map_, motion.pose().yaw_rad, std::sqrt(heading_variance_));
  }
  if (place) {
    // The next scan enters the map, once it has been matched from here as usual.
    motion.reset(place->T_map_head * T_previous_now->inverse());
    motion.matched(place->T_map_head, prior);
    motion.found(place->T_map_head, place->evidence.covariance.topLeftCorner<2, 2>());
    step.evidence = place->evidence;
    step.verdict = Verdict::weak;
    step.source = PoseSource::relocalised;
    step.lost = lost_ = false;
    recovering_ = false;
    rejected_in_a_row_ = 0;
    heading_variance_ = 0.0;
    last_.reset();
    relocaliser_.end();
    change_trust(step.verdict);
  }
  step.T_map_head = motion.pose();
  step.trust_percent = trust_percent_;
  previous_pieces_ = scan.pieces;
  note_settled(scan.scan.stamp, step.T_map_head, certain_fix());
  return step;
}

void TsdSlam::reckon(const MotionPrior& prior, const std::optional<Pose2>& T_previous_now) {
  MotionModel& motion = stories_.front().motion;
  if (T_previous_now) {
    motion.matched(motion.pose() * *T_previous_now, prior);
    return;
  }
  add_heading_doubt(prior);
  if (prior.T_previous_now) {
    motion.matched(motion.pose() * motion.predicted_step(prior), prior);
  } else {
    // A velocity from before would carry the pose through walls and out of the building.
    motion.reset(motion.pose() * Pose2{0.0, 0.0, prior.yaw_step_rad.value_or(0.0)});
  }
}

void TsdSlam::resume(TsdGrid layer, std::optional<LastPlace> last) {
  LIFELINE_CHECK(!started_ && layer.geometry() == map_.geometry());
  map_.own() = std::move(layer);
  for (const TileIndex tile : map_.own().tiles()) changed_.insert(tile);
  tracker_.forget_all();
  started_ = resumed_ = true;
  heading_variance_ = std::numbers::pi * std::numbers::pi;
  if (last) {
    look_round(last->T_map_head, last->ago, config_.motion.lost_max_yaw_rad);
    return;
  }
  lost_ = true;
  relocaliser_.begin(last_);
}

// Scans were missed, for want of time or of a working lidar: the wearer went on unseen, and what
// lies nearest to the last place need not be the right one.
void TsdSlam::bridge_gap(const MotionPrior& prior) {
  const MotionModel& motion = stories_.front().motion;
  if (prior.T_previous_now || !motion.is_gap(prior.elapsed)) return;
  UnsettledScan scan = std::move(unsettled_.back());
  unsettled_.pop_back();
  settle(0);
  unsettled_.push_back(std::move(scan));
  stories_.erase(stories_.begin() + 1, stories_.end());
  look_round(motion.pose(), prior.elapsed,
             prior.yaw_step_rad ? 0.0 : config_.motion.lost_max_yaw_rad);
  if (lost_) trust_percent_ = 0;
}

/// The helmet was at `T_map_head` and not seen since: near enough for a search, or lost.
void TsdSlam::look_round(const Pose2& T_map_head, Duration unseen, double sigma_yaw_rad) {
  const double unseen_s = to_seconds(unseen), walked_m = config_.walked_m_s * unseen_s;
  last_ = Whereabouts{T_map_head, config_.relocalise.stayed_m + config_.fastest_m_s * unseen_s};
  MotionModel& motion = stories_.front().motion;
  motion.reset(T_map_head);
  if (kReachedSigmas * walked_m <= config_.search.max_window_m) {
    motion.doubt(walked_m, sigma_yaw_rad);
    recovering_ = true;
    return;
  }
  lost_ = true;
  relocaliser_.begin(last_);
}

}  // namespace lifeline::slam
