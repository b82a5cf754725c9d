#include "agents/slam/tsd_slam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/deskew.hpp"
#include "agents/slam/submap_chain.hpp"

namespace lifeline::slam {
namespace {

FailureDetector::Config detector_config(const SlamConfig& config) {
  FailureDetector::Config detector;
  detector.min_model_points = config.min_model_points;
  detector.max_mean_error_m = config.max_mean_error_m;
  return detector;
}

/// The same step, its translation in the frame that it ends in.
Pose2 seen_from_its_end(const Pose2& step) {
  const Pose2 turn{0.0, 0.0, -step.yaw_rad};
  const Pose2 seen = turn * Pose2{step.x_m, step.y_m, 0.0};
  return {seen.x_m, seen.y_m, step.yaw_rad};
}

}  // namespace

TsdSlam::TsdSlam(SlamConfig config, GridGeometry geometry)
    : config_(config),
      map_(geometry),
      model_matcher_(config.ransac, config.icp, detector_config(config), config.max_range_m),
      tracker_(config.tracker, config.direct, config.search),
      gicp_(GicpConfig{.max_iterations = config.gicp_max_iterations}),
      detector_(detector_config(config)),
      relocaliser_(config.relocalise, geometry, config.push, config.motion, tracker_,
                   config.direct),
      updater_(geometry, config.push),
      keyframes_(config.keyframes),
      stories_(1, Story{MotionModel(config.motion), 0.0, {}}) {}

SlamStep TsdSlam::step(const Scan2& raw, const MotionPrior& prior, bool is_doubtful) {
  take_in(raw, prior);
  if (!started_) return start();
  if (!lost_) bridge_gap(prior);
  if (lost_) return step_lost(prior);

  std::vector<Story> longer;
  for (const Story& story : stories_) extend(story, prior, longer);
  keep_likely(longer, config_.stories);
  stories_ = std::move(longer);
  previous_pieces_ = unsettled_.back().pieces;

  const MatchResult& best = stories_.front().steps.back().match;
  SlamStep step{best.T_map_head,
                best.evidence,
                best.verdict,
                best.source,
                0,
                0,
                static_cast<int>(stories_.size())};
  const bool is_weak = is_doubtful || stories_.size() > 1;
  change_trust(is_weak ? std::max(best.verdict, Verdict::weak) : best.verdict);
  step.trust_percent = trust_percent_;
  note_match(prior);
  step.pushed = settle(lost_ ? 0 : static_cast<std::size_t>(config_.stories.max_unsettled));
  step.lost = lost_;
  return step;
}

void TsdSlam::take_in(const Scan2& raw, const MotionPrior& prior) {
  const StageTimer timer(times_ == nullptr ? nullptr : &times_->predict);
  Scan2 scan = raw;
  deskew(scan, seen_from_its_end(stories_.front().motion.predicted_step(prior)), prior.elapsed);
  auto pieces = extract_surface(scan, config_.surface);
  const double reach_m = reach_of(pieces);
  const bool is_walked = !prior.T_previous_now && stories_.front().motion.is_lidar_at_work();
  unsettled_.push_back({std::move(scan), std::move(pieces), reach_m, is_walked});
}

void TsdSlam::time_stages(StageTimes* times) {
  times_ = times;
  tracker_.time_stages(times);
}

SlamStep TsdSlam::start() {
  SlamStep step;
  const UnsettledScan scan = std::move(unsettled_.back());
  unsettled_.clear();
  step.evidence.points = static_cast<int>(scan.pieces.size());
  if (step.evidence.points < config_.min_model_points) {
    settled_.push_back({scan.scan.stamp, 0, {}, certain_fix()});
    return step;
  }
  started_ = true;
  trust_percent_ = 100;
  push(scan.pieces, {}, scan.scan.stamp);
  keyframes_.keep(scan.scan.stamp, {}, Eigen::Matrix3d::Zero(), scan.pieces);
  settled_.push_back({scan.scan.stamp, 1, {}, certain_fix()});
  previous_pieces_ = scan.pieces;
  step.verdict = Verdict::accepted;
  step.source = PoseSource::start;
  step.pushed = 1;
  step.trust_percent = trust_percent_;
  return step;
}

void TsdSlam::extend(const Story& story, const MotionPrior& prior, std::vector<Story>& longer) {
  const Prediction prediction = story.motion.predict(prior);
  for (ScoredMatch& found : place(prediction, story, story.motion.predicted_step(prior))) {
    Story next = story;
    next.score += found.score;
    // After scans that nothing matched, only a match beyond doubt tells where the helmet is.
    if (recovering_ && found.match.evidence.inlier_share() < config_.tracker.sure_share) {
      found.match.verdict = Verdict::rejected;
    }
    const PositionFix fix = fix_of(found.match, prediction, story.motion, prior);
    if (found.match.verdict == Verdict::rejected) {
      found.match.T_map_head = prediction.T_map_head;
      found.match.source = PoseSource::dead_reckoning;
      next.motion.lost(prediction, prior);
    } else if (recovering_) {
      recover(found.match, next.motion);
    } else {
      next.motion.matched(found.match.T_map_head, prior, fix);
    }
    next.steps.push_back({std::move(found.match), prediction, fix});
    longer.push_back(std::move(next));
  }
}

PositionFix TsdSlam::fix_of(const MatchResult& match, const Prediction& prediction,
                            const MotionModel& motion, const MotionPrior& prior) const {
  if (!unsettled_.back().is_walked) return certain_fix();
  PositionFix fix = position_fix(match, prediction);
  if (prior.elapsed <= Duration{0}) return fix;
  fix.after_stamp_s = half_sweep_s(prior);
  const Eigen::Vector2d step_m = prediction.T_map_head.translation() - motion.pose().translation();
  fix.ahead_m = step_m * (fix.after_stamp_s / to_seconds(prior.elapsed));
  return fix;
}

std::vector<ScoredMatch> TsdSlam::place(const Prediction& prediction, const Story& story,
                                        const Pose2& predicted_step) {
  const UnsettledScan& scan = unsettled_.back();
  if (scan.pieces.empty()) return {ScoredMatch{}};
  const double margin_m = 2.0 + config_.search.max_window_m;
  view_.assign(map_, prediction.T_map_head.translation(), scan.reach_m + margin_m);
  std::vector<ScoredMatch> found;
  if (config_.matcher == Matcher::direct) {
    found = tracker_.match(map_, view_, scan.pieces, prediction);
    if (found.size() == 1 && stories_.size() > 1) {
      ScoredMatch& only = found.front();
      only.score = tracker_.score(view_, only.match.T_map_head, prediction);
    }
  } else {
    const StageTimer timer(times_ == nullptr ? nullptr : &times_->match);
    found.push_back({match_by_model(prediction, story), 0.0});
  }
  // A helmet that has several stories lives on those that still match; one that was blind does not
  // know from where the step would lead.
  if (found.front().match.verdict == Verdict::rejected && stories_.size() == 1 && !recovering_ &&
      config_.matcher != Matcher::conventional) {
    const StageTimer timer(times_ == nullptr ? nullptr : &times_->match);
    found.assign(1, {match_previous_scan(prediction, story.motion.pose(), predicted_step), 0.0});
  }
  return found;
}

MatchResult TsdSlam::match_by_model(const Prediction& prediction, const Story& story) const {
  const UnsettledScan& seen = unsettled_.back();
  MatchResult result =
      model_matcher_.match(view_, story.motion.pose(), seen.scan, seen.pieces, prediction);
  // Conventional TSD SLAM has no failure detection: whatever was matched to anything counts.
  if (config_.matcher == Matcher::conventional && result.evidence.model_points > 0) {
    result.verdict = Verdict::accepted;
  }
  return result;
}

MatchResult TsdSlam::match_previous_scan(const Prediction& prediction, const Pose2& last_pose,
                                         const Pose2& predicted_step) const {
  const PointSet model = to_points(previous_pieces_), scan = to_points(unsettled_.back().pieces);
  const Pose2 T_previous_now = gicp_.match(model, scan, predicted_step);
  const MatchError error = detector_.measure(model, scan, T_previous_now);
  MatchResult result;
  result.source = PoseSource::scan_to_scan;
  result.T_map_head = last_pose * T_previous_now;
  result.evidence.points = static_cast<int>(scan.size());
  result.evidence.known = static_cast<int>(model.size());
  result.evidence.inliers = result.evidence.model_points = error.model_points;
  result.evidence.mean_error_m = error.mean_error_m;
  const Pose2 off = prediction.T_map_head.inverse() * result.T_map_head;
  const bool believable = off.translation().norm() < 4.0 * prediction.largest_sigma_m() + 0.2 &&
                          std::abs(off.yaw_rad) < 4.0 * prediction.sigma_yaw_rad + 0.05;
  result.verdict = detector_.detect(error) || !believable ? Verdict::rejected : Verdict::accepted;
  return result;
}

void TsdSlam::change_trust(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      trust_percent_ = std::min(100, trust_percent_ + 20);
      break;
    case Verdict::weak:
      trust_percent_ = std::max(20, trust_percent_ - 5);
      break;
    case Verdict::rejected:
      trust_percent_ = std::max(0, trust_percent_ - 20);
      break;
  }
}

std::vector<TileIndex> TsdSlam::take_changed_tiles() {
  std::vector<TileIndex> taken(changed_.begin(), changed_.end());
  changed_.clear();
  return taken;
}

void TsdSlam::set_peer_tile(TileIndex tile, std::shared_ptr<const TsdTile> cells) {
  map_.set_peer_tile(tile, std::move(cells));
  relocaliser_.map_changed();
  tracker_.forget(std::span(&tile, 1));
}

void TsdSlam::clear_peers() {
  map_.clear_peers();
  relocaliser_.map_changed();
  tracker_.forget_all();
}

void TsdSlam::set_own_weight(double w_T1) {
  map_.set_own_weight(w_T1);
  if (!map_.has_peers()) return;
  tracker_.forget_all();
  relocaliser_.map_changed();
}

}  // namespace lifeline::slam
