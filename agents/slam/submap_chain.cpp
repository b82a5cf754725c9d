#include "agents/slam/submap_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/covariance.hpp"

namespace lifeline::slam {

double reach_of(std::span<const SurfacePiece> pieces) {
  float reach_m = 0.0F;
  for (const SurfacePiece& piece : pieces) reach_m = std::max(reach_m, piece.point.norm());
  return static_cast<double>(reach_m);
}

SubmapChain::SubmapChain(const SubmapConfig& config, GridGeometry geometry,
                         const MapTracker& tracker)
    : config_(config), geometry_(geometry), tracker_(tracker) {}

void SubmapChain::start(std::span<const SurfacePiece> pieces, TsdUpdater& updater) {
  begin_submap(0);
  begin_submap(0);
  draw(pieces, updater);
}

void SubmapChain::end() {
  older_ = {};
  newer_ = {};
  tracker_.forget_all();
}

GraphEdge SubmapChain::add(std::size_t index, const Keyframe& keyframe,
                           std::span<const SurfacePiece> pieces, TsdUpdater& updater) {
  const Pose2& step = keyframe.T_previous_this;
  const bool doubtful =
      exceeds(keyframe.step_covariance, config_.doubtful_xy_m, config_.doubtful_yaw_rad);
  const GraphEdge edge = doubtful
                             ? GraphEdge{index - 1, index, step, keyframe.step_covariance, false}
                             : measure(index, keyframe, pieces);
  const Pose2 T_older_this =
      edge.from == older_.first ? edge.T_from_to : older_.T_first_last * edge.T_from_to;
  newer_.T_first_last = newer_.T_first_last * older_.T_first_last.inverse() * T_older_this;
  older_.T_first_last = T_older_this;
  older_.path_m += step.translation().norm();
  newer_.path_m += step.translation().norm();
  // Behind a doubtful step both begin anew: what comes must not be held to what was before it.
  if (doubtful) begin_submap(index);
  if (doubtful || newer_.path_m >= config_.path_m) begin_submap(index);
  draw(pieces, updater);
  return edge;
}

GraphEdge SubmapChain::measure(std::size_t index, const Keyframe& keyframe,
                               std::span<const SurfacePiece> pieces) {
  const Pose2& step = keyframe.T_previous_this;
  const GraphEdge tracked{index - 1, index, step, keyframe.step_covariance, false};
  const Prediction prediction{older_.T_first_last * step, config_.sigma_xy_m,
                              config_.sigma_yaw_rad};
  TsdView view;
  view.assign(*older_.map, prediction.T_map_head.translation(), reach_of(pieces) + 4.0);
  tracker_.forget_all();
  const MatchResult match = tracker_.match(*older_.map, view, pieces, prediction).front().match;
  if (match.verdict != Verdict::accepted) return tracked;
  const Pose2 off = prediction.T_map_head.inverse() * match.T_map_head;
  if (off.translation().norm() < config_.snap_xy_m &&
      std::abs(off.yaw_rad) < config_.snap_yaw_rad) {
    return tracked;
  }
  const Eigen::Matrix3d covariance =
      match.evidence.covariance + diagonal_covariance(config_.noise_xy_m, config_.noise_yaw_rad);
  return {older_.first, index, match.T_map_head, covariance, false};
}

void SubmapChain::begin_submap(std::size_t first) {
  older_ = std::move(newer_);
  newer_ = {first, 0.0, {}, std::make_unique<WorkingMap>(geometry_)};
}

void SubmapChain::draw(std::span<const SurfacePiece> pieces, TsdUpdater& updater) {
  (void)updater.push(pieces, older_.T_first_last, 1.0, older_.map->own());
  (void)updater.push(pieces, newer_.T_first_last, 1.0, newer_.map->own());
}

}  // namespace lifeline::slam
