// What TsdSlam does with scans that are settled: pushes them, keeps their places, takes over their
// correction (docs/decisions/0205, 0206).
#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/submap_chain.hpp"
#include "agents/slam/tsd_slam.hpp"
#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {

/// So many scans that found no place are kept for a second look.
constexpr std::size_t kMaxUnplaced = 500;

}  // namespace

int TsdSlam::settle(std::size_t most_unsettled) {
  int pushed = 0;
  while (!unsettled_.empty() && (unsettled_.size() > most_unsettled || agree_on_oldest(stories_))) {
    const StoryStep step = stories_.front().steps.front();
    settle_oldest(stories_);
    pushed += settle_scan(unsettled_.front(), step) ? 1 : 0;
    unsettled_.erase(unsettled_.begin());
  }
  if (stories_.size() == 1) stories_.front().score = 0.0;
  return pushed;
}

bool TsdSlam::settle_scan(const UnsettledScan& scan, const StoryStep& step) {
  const Pose2& T_map_head = step.match.T_map_head;
  const bool accepted = step.match.verdict == Verdict::accepted;
  if (!accepted) {
    keyframes_.note_lost(step.prediction);
    if (unplaced_.size() < kMaxUnplaced) {
      unplaced_.push_back({settled_.size(), step.prediction.largest_sigma_m(),
                           step.prediction.sigma_yaw_rad, PackedSurface(scan.pieces)});
    }
  }
  const bool pushes = accepted && push_is_due(T_map_head, scan.scan.stamp);
  if (pushes) {
    push(scan.pieces, T_map_head, scan.scan.stamp);
    if (keyframes_.is_due(T_map_head)) {
      keyframes_.keep(scan.scan.stamp, T_map_head, step.match.evidence.covariance, scan.pieces);
    }
  }
  note_settled(scan.scan.stamp, T_map_head, step.fix);
  return pushes;
}

void TsdSlam::note_settled(Timestamp stamp, const Pose2& T_map_head, const PositionFix& fix) {
  const Pose2 T_map_keyframe = keyframes_.size() == 0 ? Pose2{} : keyframes_.poses().back();
  settled_.push_back({stamp, keyframes_.size(), T_map_keyframe.inverse() * T_map_head, fix});
}

void TsdSlam::settle_all() {
  settle(0);
}

std::vector<StampedPose> TsdSlam::trajectory(std::size_t first) const {
  std::vector<StampedPose> trajectory;
  for (std::size_t i = first; i < settled_.size(); ++i) {
    trajectory.push_back({settled_[i].stamp, pose_of(settled_[i])});
  }
  return trajectory;
}

Pose2 TsdSlam::pose_of(const SettledScan& scan) const {
  const Pose2 T_map_keyframe =
      scan.keyframes == 0 ? Pose2{} : keyframes_.poses()[scan.keyframes - 1];
  return T_map_keyframe * scan.T_keyframe_head;
}

int TsdSlam::revisit() {
  int found = 0;
  std::vector<SurfacePiece> pieces;
  for (const UnplacedScan& unplaced : std::exchange(unplaced_, {})) {
    pieces.clear();
    unplaced.surface.unpack(pieces);
    if (pieces.empty()) continue;
    SettledScan& scan = settled_[unplaced.settled];
    const Prediction prediction{pose_of(scan), unplaced.sigma_xy_m, unplaced.sigma_yaw_rad};
    view_.assign(map_, prediction.T_map_head.translation(),
                 reach_of(pieces) + 2.0 + config_.search.max_window_m);
    const MatchResult match = tracker_.match(map_, view_, pieces, prediction).front().match;
    if (match.verdict != Verdict::accepted) continue;
    scan.T_keyframe_head =
        scan.T_keyframe_head * (prediction.T_map_head.inverse() * match.T_map_head);
    scan.fix = certain_fix();
    ++found;
  }
  return found;
}

void TsdSlam::smooth_trajectory() {
  std::vector<PathPlace> path;
  path.reserve(settled_.size());
  for (const SettledScan& scan : settled_)
    path.push_back({scan.stamp, pose_of(scan).translation(), scan.fix});
  const std::vector<Eigen::Vector2d> smoothed = smooth_path(path);
  for (std::size_t i = 0; i < settled_.size(); ++i) {
    SettledScan& scan = settled_[i];
    const Pose2 T_map_head = pose_of(scan);
    const Pose2 T_keyframe_map = scan.T_keyframe_head * T_map_head.inverse();
    scan.T_keyframe_head =
        T_keyframe_map * Pose2{smoothed[i].x(), smoothed[i].y(), T_map_head.yaw_rad};
  }
}

double TsdSlam::since_push_s(Timestamp stamp) const {
  return std::abs(to_seconds(stamp - pushed_stamp_));
}

bool TsdSlam::push_is_due(const Pose2& T_map_head, Timestamp stamp) const {
  const Pose2 moved = pushed_at_.inverse() * T_map_head;
  return moved.translation().norm() >= config_.push_distance_m ||
         std::abs(moved.yaw_rad) >= config_.push_turn_rad ||
         since_push_s(stamp) >= config_.push_interval_s;
}

void TsdSlam::push(std::span<const SurfacePiece> pieces, const Pose2& T_map_head, Timestamp stamp) {
  const StageTimer timer(times_ == nullptr ? nullptr : &times_->push);
  const bool is_dense = since_push_s(stamp) < config_.dense_interval_s;
  const Looks looks = is_dense ? Looks::dense : Looks::sparse;
  const auto changed = updater_.push(pieces, T_map_head, 1.0, map_.own(), looks);
  map_.note_own_changed(changed);
  tracker_.forget(changed);
  changed_.insert(changed.begin(), changed.end());
  pushed_at_ = T_map_head;
  pushed_stamp_ = stamp;
}

bool TsdSlam::apply(MapCorrection correction) {
  const std::size_t keyframes = correction.T_map_head.size();
  return apply(keyframes, [&] { return std::move(correction); });
}

bool TsdSlam::apply(std::size_t keyframes, const std::function<MapCorrection()>& work_out) {
  if (resumed_ || !keyframes_.can_rebase(keyframes)) return false;
  for (const TileIndex tile : map_.own().tiles()) changed_.insert(tile);
  map_.own().clear();
  tracker_.forget_all();
  MapCorrection correction = work_out();
  LIFELINE_CHECK(correction.T_map_head.size() == keyframes);
  const auto T_new_old = keyframes_.rebase(correction);
  map_.own() = std::move(correction.layer);
  std::vector<SurfacePiece> pieces;
  for (const Keyframe& keyframe : keyframes_.unknown_to(correction)) {
    pieces.clear();
    keyframe.surface.unpack(pieces);
    (void)updater_.push(pieces, keyframe.T_map_head, 1.0, map_.own());
  }
  for (const TileIndex tile : map_.own().tiles()) changed_.insert(tile);
  map_.note_own_changed(std::vector<TileIndex>(changed_.begin(), changed_.end()));
  relocaliser_.map_changed();
  for (Story& story : stories_) {
    story.motion.move(*T_new_old);
    for (StoryStep& step : story.steps) {
      step.match.T_map_head = *T_new_old * step.match.T_map_head;
      step.prediction.T_map_head = *T_new_old * step.prediction.T_map_head;
    }
  }
  pushed_at_ = *T_new_old * pushed_at_;
  return true;
}

}  // namespace lifeline::slam
