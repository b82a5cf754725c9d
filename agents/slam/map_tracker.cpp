#include "agents/slam/map_tracker.hpp"

#include <cmath>

namespace lifeline::slam {
namespace {
/// Enough for a trial to come close; the best one is aligned to the end.
constexpr int kTrialIterations = 6;
}  // namespace

MatchResult MapTracker::match(const WorkingMap& map, const TsdView& view,
                              std::span<const SurfacePiece> pieces, const Prediction& prediction) {
  direct_.set_scan(pieces);
  const Pose2 local_pose = direct_.align(view, prediction);
  MatchResult local = judged(view, local_pose, PoseSource::map, prediction);
  if (!needs_search(local, prediction)) return local;

  Pose2 best_pose = local_pose;
  double best_score = score(view, local_pose, prediction);
  bool found = false;
  for (const SearchCandidate& candidate : search_.search(map, pieces, prediction)) {
    const Pose2 pose = direct_.align(view, candidate.T_map_head, prediction, kTrialIterations);
    const double pose_score = score(view, pose, prediction);
    if (pose_score <= best_score) continue;
    best_score = pose_score;
    best_pose = pose;
    found = true;
  }
  if (!found) return local;
  best_pose = direct_.align(view, best_pose, prediction, 2 * kTrialIterations);
  return judged(view, best_pose, PoseSource::search, prediction);
}

bool MapTracker::needs_search(const MatchResult& local, const Prediction& prediction) const {
  if (prediction.sigma_xy_m > config_.search_sigma_m) return true;
  if (local.evidence.inlier_share() >= config_.sure_share) return false;
  return local.verdict != Verdict::accepted ||
         prediction.sigma_yaw_rad * config_.lever_m > config_.search_sigma_m;
}

double MapTracker::score(const TsdView& view, const Pose2& T_map_head,
                         const Prediction& prediction) const {
  const Pose2& expected = prediction.T_map_head;
  const double xy =
      (T_map_head.translation() - expected.translation()).norm() / prediction.sigma_xy_m;
  const double yaw =
      normalise_angle(T_map_head.yaw_rad - expected.yaw_rad) / prediction.sigma_yaw_rad;
  return search_.config().independent_points * direct_.agreement(view, T_map_head) -
         0.5 * (xy * xy + yaw * yaw);
}

MatchResult MapTracker::judged(const TsdView& view, const Pose2& T_map_head, PoseSource source,
                               const Prediction& prediction) const {
  MatchResult result;
  result.T_map_head = T_map_head;
  result.source = source;
  result.evidence = direct_.judge(view, T_map_head, prediction);
  const double share = result.evidence.inlier_share();
  if (result.evidence.known >= config_.min_known && share >= config_.accept_share) {
    result.verdict = Verdict::accepted;
  } else if (result.evidence.known >= config_.min_known && share >= config_.weak_share) {
    result.verdict = Verdict::weak;
  }
  return result;
}

}  // namespace lifeline::slam
