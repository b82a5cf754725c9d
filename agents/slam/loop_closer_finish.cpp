// What LoopCloser does when no more keyframes come: looks once more at all that was seen twice, at
// what fits poorly, and at every keyframe (docs/decisions/0206).
#include <algorithm>
#include <cmath>

#include "agents/slam/covariance.hpp"
#include "agents/slam/loop_closer.hpp"

namespace lifeline::slam {

std::optional<MapCorrection> LoopCloser::finish() {
  chain_.end();
  if (loops_ > 0) optimise(poses_, edges_, config_.graph);
  const bool corrected = redrawn_ || has_moved();
  for (int round = 0; corrected && round < config_.tie_rounds; ++round) tie_places();
  if (reconsider() == 0 && !corrected) return std::nullopt;
  if (corrected) polish();
  place_.own().clear();  // as large as the layer that is drawn next
  return correction();
}

void LoopCloser::draw_all() {
  place_.own().clear();  // not both at once
  place_.own() = drawn_layer();
}

void LoopCloser::tie_places() {
  std::vector<GraphEdge> ties;
  double next_m = 0.0;
  for (std::size_t now = 0; now < keyframes_.size(); ++now) {
    if (path_m_[now] < next_m) continue;
    const auto old_index = old_place(now);
    if (!old_index) continue;
    next_m = path_m_[now] + config_.tie_path_m;
    const auto tie =
        measure(*old_index, now, {poses_[now], config_.tie_sigma_xy_m, config_.tie_sigma_yaw_rad});
    if (tie) ties.push_back(*tie);
  }
  std::erase_if(edges_, [](const GraphEdge& edge) { return edge.may_be_wrong; });
  edges_.insert(edges_.end(), ties.begin(), ties.end());
  optimise(poses_, edges_, config_.graph);
}

int LoopCloser::reconsider() {
  draw_all();
  std::vector<std::size_t> doubtful;
  for (std::size_t i = 1; i < keyframes_.size(); ++i) {
    if (is_doubtful(i)) doubtful.push_back(i);
  }
  int moved = 0;
  for (const std::size_t i : doubtful) {
    draw_others(i);
    const Eigen::Matrix3d& step = keyframes_[i].step_covariance;
    const Prediction here{poses_[i],
                          std::max(config_.doubtful_sigma_xy_m, std::sqrt(step(0, 0) + step(1, 1))),
                          std::max(config_.submaps.doubtful_yaw_rad, std::sqrt(step(2, 2)))};
    const std::vector<SurfacePiece>& pieces = unpacked(i);
    TsdView view;
    view.assign(place_, poses_[i].translation(), reach_of(pieces) + 4.0);
    const ScoredMatch best = tracker_.match(place_, view, pieces, here).front();
    if (best.match.verdict != Verdict::accepted ||
        best.score < tracker_.score(view, poses_[i], here) + config_.doubtful_margin) {
      continue;
    }
    poses_[i] = best.match.T_map_head;
    ++moved;
  }
  return moved;
}

bool LoopCloser::is_doubtful(std::size_t index) {
  if (exceeds(keyframes_[index].step_covariance, config_.submaps.doubtful_xy_m,
              config_.submaps.doubtful_yaw_rad)) {
    return true;
  }
  const std::vector<SurfacePiece>& pieces = unpacked(index);
  TsdView view;
  view.assign(place_, poses_[index].translation(), reach_of(pieces) + 1.0);
  direct_.set_scan(pieces);
  const MatchEvidence evidence = direct_.judge(
      view, poses_[index], {poses_[index], config_.tie_sigma_xy_m, config_.tie_sigma_yaw_rad});
  return evidence.inlier_share() < config_.doubtful_share;
}

void LoopCloser::draw_others(std::size_t index) {
  place_.own().clear();
  tracker_.forget_all();
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (i == index ||
        (poses_[i].translation() - poses_[index].translation()).norm() > config_.doubtful_reach_m) {
      continue;
    }
    (void)updater_.push(unpacked(i), poses_[i], 1.0, place_.own());
  }
}

void LoopCloser::polish() {
  draw_all();
  TsdView view;
  for (std::size_t i = 1; i < keyframes_.size(); ++i) {
    const std::vector<SurfacePiece>& pieces = unpacked(i);
    view.assign(place_, poses_[i].translation(), reach_of(pieces) + 1.0);
    direct_.set_scan(pieces);
    const Pose2 aligned =
        direct_.align(view, {poses_[i], config_.polish_sigma_xy_m, config_.polish_sigma_yaw_rad});
    const double moved_m = (aligned.translation() - poses_[i].translation()).norm();
    if (moved_m <= config_.polish_max_m) poses_[i] = aligned;
  }
}

}  // namespace lifeline::slam
