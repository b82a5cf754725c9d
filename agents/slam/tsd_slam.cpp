#include "agents/slam/tsd_slam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/deskew.hpp"

namespace lifeline::slam {
namespace {

FailureDetector::Config detector_config(const SlamConfig& config) {
  FailureDetector::Config detector;
  detector.min_model_points = config.min_model_points;
  detector.max_mean_error_m = config.max_mean_error_m;
  return detector;
}

double reach_of(const Scan2& scan) {
  float reach_m = 0.0F;
  for (const Beam2& beam : scan.beams) {
    if (beam.kind == BeamKind::hit) reach_m = std::max(reach_m, beam.range_m);
  }
  return static_cast<double>(reach_m);
}

}  // namespace

TsdSlam::TsdSlam(SlamConfig config, GridGeometry geometry)
    : config_(config),
      map_(geometry),
      motion_(config.motion),
      model_matcher_(config.ransac, config.icp, detector_config(config), config.max_range_m),
      tracker_(config.tracker, config.direct, config.search),
      gicp_(GicpConfig{.max_iterations = config.gicp_max_iterations}),
      detector_(detector_config(config)),
      updater_(geometry, config.push) {}

SlamStep TsdSlam::step(const Scan2& raw, const MotionPrior& prior) {
  Scan2 scan = raw;
  const Pose2 predicted_step = motion_.predicted_step(prior);
  deskew(scan, predicted_step, prior.elapsed);
  pieces_ = extract_surface(scan, config_.surface);
  if (!started_) return start(scan);

  const Prediction prediction = motion_.predict(prior);
  const MatchResult result = place(scan, prediction, predicted_step);
  SlamStep step{result.T_map_head, result.evidence, result.verdict, result.source, false, 0};
  if (result.verdict == Verdict::rejected) {
    step.T_map_head = prediction.T_map_head;
    step.source = PoseSource::dead_reckoning;
    motion_.lost(prediction);
  } else {
    motion_.matched(result.T_map_head, prior);
  }
  change_trust(result.verdict);
  step.trust_percent = trust_percent_;
  if (result.verdict == Verdict::accepted && push_is_due(result.T_map_head, scan.stamp)) {
    push(scan, result.T_map_head);
    step.pushed = true;
  }
  previous_pieces_ = std::move(pieces_);
  return step;
}

SlamStep TsdSlam::start(const Scan2& scan) {
  SlamStep step;
  step.evidence.points = static_cast<int>(pieces_.size());
  if (static_cast<int>(pieces_.size()) < config_.min_model_points) return step;
  started_ = true;
  motion_.reset({});
  push(scan, {});
  previous_pieces_ = pieces_;
  trust_percent_ = 100;
  step.verdict = Verdict::accepted;
  step.source = PoseSource::start;
  step.pushed = true;
  step.trust_percent = trust_percent_;
  return step;
}

MatchResult TsdSlam::place(const Scan2& scan, const Prediction& prediction,
                           const Pose2& predicted_step) {
  MatchResult result;
  if (pieces_.empty()) return result;
  const double margin_m = 2.0 + config_.search.max_window_m;
  view_.assign(map_, prediction.T_map_head.translation(), reach_of(scan) + margin_m);
  if (config_.matcher == Matcher::direct) {
    result = tracker_.match(map_, view_, pieces_, prediction);
  } else {
    result = model_matcher_.match(view_, motion_.pose(), scan, pieces_, prediction);
    // Conventional TSD SLAM has no failure detection: whatever was matched to anything counts.
    if (config_.matcher == Matcher::conventional && result.evidence.model_points > 0) {
      result.verdict = Verdict::accepted;
    }
  }
  if (result.verdict != Verdict::rejected || config_.matcher == Matcher::conventional) {
    return result;
  }
  return match_previous_scan(prediction, predicted_step);
}

MatchResult TsdSlam::match_previous_scan(const Prediction& prediction,
                                         const Pose2& predicted_step) const {
  const PointSet model = to_points(previous_pieces_), scan = to_points(pieces_);
  const Pose2 T_previous_now = gicp_.match(model, scan, predicted_step);
  const MatchError error = detector_.measure(model, scan, T_previous_now);
  MatchResult result;
  result.source = PoseSource::scan_to_scan;
  result.T_map_head = motion_.pose() * T_previous_now;
  result.evidence.points = static_cast<int>(scan.size());
  result.evidence.known = static_cast<int>(model.size());
  result.evidence.inliers = result.evidence.model_points = error.model_points;
  result.evidence.mean_error_m = error.mean_error_m;
  const Pose2 off = prediction.T_map_head.inverse() * result.T_map_head;
  const bool believable = off.translation().norm() < 4.0 * prediction.sigma_xy_m + 0.2 &&
                          std::abs(off.yaw_rad) < 4.0 * prediction.sigma_yaw_rad + 0.05;
  result.verdict = detector_.detect(error) || !believable ? Verdict::rejected : Verdict::accepted;
  return result;
}

bool TsdSlam::push_is_due(const Pose2& T_map_head, Timestamp stamp) const {
  const Pose2 moved = pushed_at_.inverse() * T_map_head;
  return moved.translation().norm() >= config_.push_distance_m ||
         std::abs(moved.yaw_rad) >= config_.push_turn_rad ||
         std::abs(to_seconds(stamp - pushed_stamp_)) >= config_.push_interval_s;
}

void TsdSlam::push(const Scan2& scan, const Pose2& T_map_head) {
  const auto changed = updater_.push(pieces_, T_map_head, 1.0, map_.own());
  map_.note_own_changed(changed);
  tracker_.forget(changed);
  changed_.insert(changed.begin(), changed.end());
  pushed_at_ = T_map_head;
  pushed_stamp_ = scan.stamp;
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
  tracker_.forget(std::span(&tile, 1));
}

void TsdSlam::clear_peers() {
  map_.clear_peers();
  tracker_.forget_all();
}

void TsdSlam::set_own_weight(double w_T1) {
  map_.set_own_weight(w_T1);
  if (map_.has_peers()) tracker_.forget_all();
}

}  // namespace lifeline::slam
