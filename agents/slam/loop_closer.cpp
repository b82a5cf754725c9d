#include "agents/slam/loop_closer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agents/slam/covariance.hpp"
#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {

/// Rivals within this much of the best are looked at for the margin.
constexpr double kRivalScore = 30.0;

TrackerConfig strict(TrackerConfig tracker, const LoopConfig& loop) {
  tracker.accept_share = loop.accept_share;
  tracker.min_known = loop.min_known;
  tracker.rival_score = kRivalScore;
  return tracker;
}

double margin_of(const std::vector<ScoredMatch>& matches) {
  return matches.size() > 1 ? matches[0].score - matches[1].score : kRivalScore;
}

/// A lidar of half a circle came back the other way sees half of what it saw then.
bool looks_behind(const std::vector<SurfacePiece>& pieces) {
  const auto behind = std::count_if(pieces.begin(), pieces.end(),
                                    [](const SurfacePiece& piece) { return piece.point.x() < 0; });
  return static_cast<std::size_t>(behind) > pieces.size() / 5;
}

}  // namespace

LoopCloser::LoopCloser(const LoopConfig& config, GridGeometry geometry, const PushConfig& push,
                       const TrackerConfig& tracker, const DirectConfig& direct,
                       const SearchConfig& search)
    : config_(config),
      updater_(geometry, push),
      tracker_(strict(tracker, config), direct, search),
      direct_(direct),
      chain_(config.submaps, geometry, tracker_),
      place_(geometry) {}

bool LoopCloser::take(Keyframe keyframe) {
  LIFELINE_CHECK(keyframe.index == keyframes_.size());
  append(keyframe);
  keyframes_.push_back(std::move(keyframe));
  if (path_m_.back() < next_attempt_m_) return false;
  const std::size_t now = keyframes_.size() - 1;
  const auto old_index = old_place(now);
  if (!old_index) return false;
  next_attempt_m_ = path_m_.back() + config_.attempt_path_m;
  const auto edge = measure(*old_index, now, predict(*old_index));
  place_.own().clear();  // until the next attempt
  if (!edge || !believe(*edge)) return false;
  optimise(poses_, edges_, config_.graph);
  return has_moved();
}

MapCorrection LoopCloser::correction() {
  TsdGrid layer = drawn_layer();
  return {poses_, std::move(layer)};
}

void LoopCloser::append(const Keyframe& keyframe) {
  scratch_.clear();
  keyframe.surface.unpack(scratch_);
  if (keyframes_.empty()) {
    path_m_.push_back(0.0);
    poses_.push_back(keyframe.T_map_head);
    drawn_poses_.push_back(keyframe.T_map_head);
    chain_.start(scratch_, updater_);
    return;
  }
  const GraphEdge edge = chain_.add(keyframes_.size(), keyframe, scratch_, updater_);
  path_m_.push_back(path_m_.back() + keyframe.T_previous_this.translation().norm());
  poses_.push_back(poses_[edge.from] * edge.T_from_to);
  drawn_poses_.push_back(drawn_poses_.back() * keyframe.T_previous_this);
  edges_.push_back(edge);
  const Eigen::Matrix3d& step = keyframe.step_covariance;
  if (exceeds(step, config_.lost_xy_m, config_.lost_yaw_rad)) lost_ += step;
}

std::optional<std::size_t> LoopCloser::old_place(std::size_t now) const {
  const Pose2& here = poses_[now];
  std::optional<std::size_t> best;
  double best_m = std::numeric_limits<double>::max();
  for (std::size_t i = 0; path_m_[now] - path_m_[i] >= config_.min_path_m; ++i) {
    const double apart_m = (poses_[i].translation() - here.translation()).norm();
    if (apart_m > config_.near_m) continue;
    const double turned = 1.0 - std::cos(poses_[i].yaw_rad - here.yaw_rad);
    const double cost_m = apart_m + config_.turn_worth_m * turned;
    if (cost_m >= best_m) continue;
    best_m = cost_m;
    best = i;
  }
  return best;
}

const std::vector<SurfacePiece>& LoopCloser::unpacked(std::size_t index) {
  scratch_.clear();
  keyframes_[index].surface.unpack(scratch_);
  return scratch_;
}

void LoopCloser::draw_place(std::size_t old_index, std::size_t now) {
  place_.own().clear();
  tracker_.forget_all();
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (std::abs(path_m_[i] - path_m_[old_index]) > config_.old_reach_m) continue;
    if (path_m_[now] - path_m_[i] < 0.5 * config_.min_path_m) break;
    (void)updater_.push(unpacked(i), poses_[i], 1.0, place_.own());
  }
}

std::vector<SurfacePiece> LoopCloser::surface_before(std::size_t now) const {
  std::vector<SurfacePiece> recent, pieces;
  const Pose2 T_head_map = poses_[now].inverse();
  for (std::size_t i = now + 1; i-- > 0;) {
    if (path_m_[now] - path_m_[i] > config_.new_reach_m) break;
    pieces.clear();
    keyframes_[i].surface.unpack(pieces);
    const PointTransform T_head_then(T_head_map * poses_[i]);
    for (const SurfacePiece& piece : pieces) recent.push_back(moved(piece, T_head_then));
  }
  return recent;
}

Prediction LoopCloser::predict(std::size_t old_index) const {
  const double path_m = path_m_.back() - std::max(path_m_[old_index], closed_at_m_);
  const double xy_m = std::hypot(config_.sigma_xy_m + config_.drift_xy * path_m,
                                 std::sqrt(lost_(0, 0) + lost_(1, 1)));
  const double yaw_rad =
      std::hypot(config_.sigma_yaw_rad + config_.drift_yaw_rad_m * path_m, std::sqrt(lost_(2, 2)));
  return {poses_.back(), std::min(xy_m, config_.max_sigma_xy_m),
          std::min(yaw_rad, config_.max_sigma_yaw_rad)};
}

std::optional<GraphEdge> LoopCloser::measure(std::size_t old_index, std::size_t now,
                                             const Prediction& prediction) {
  draw_place(old_index, now);
  const std::vector<SurfacePiece> recent = surface_before(now);
  TsdView view;
  view.assign(place_, prediction.T_map_head.translation(), reach_of(recent) + 4.0);
  const auto matches = tracker_.match(place_, view, recent, prediction);
  const MatchResult& match = matches.front().match;
  // Seen through a door, or from behind a thin wall, a place is not the same place.
  const double share =
      looks_behind(unpacked(now)) ? config_.min_known_share : config_.min_known_share_ahead;
  const bool same_place = match.evidence.known >= share * match.evidence.points;
  if (match.verdict != Verdict::accepted || !same_place ||
      margin_of(matches) < config_.min_margin) {
    return std::nullopt;
  }
  const Pose2& T_map_old = poses_[old_index];
  const Eigen::Matrix3d covariance = turn_covariance(match.evidence.covariance, T_map_old.yaw_rad) +
                                     diagonal_covariance(config_.noise_xy_m, config_.noise_yaw_rad);
  return GraphEdge{old_index, now, T_map_old.inverse() * match.T_map_head, covariance, true};
}

bool LoopCloser::believe(const GraphEdge& edge) {
  if (is_surprising(edge)) {
    if (!surprise_ || !confirms(edge, *surprise_)) {
      surprise_ = edge;
      return false;
    }
    close(*surprise_);
  }
  surprise_.reset();
  close(edge);
  closed_at_m_ = path_m_.back();
  lost_.setZero();
  return true;
}

bool LoopCloser::is_surprising(const GraphEdge& edge) const {
  const Pose2 moved = poses_[edge.to].inverse() * poses_[edge.from] * edge.T_from_to;
  return moved.translation().norm() > config_.surprise_xy_m ||
         std::abs(moved.yaw_rad) > config_.surprise_yaw_rad;
}

bool LoopCloser::confirms(const GraphEdge& edge, const GraphEdge& surprise) const {
  if (path_m_[edge.to] - path_m_[surprise.to] > config_.surprise_path_m) return false;
  const auto correction_of = [&](const GraphEdge& e) {  // of the present, in the map
    return poses_[e.from] * e.T_from_to * poses_[e.to].inverse();
  };
  const Pose2 first = correction_of(surprise), second = correction_of(edge);
  const Eigen::Vector2d here = poses_[edge.to].translation();
  return (first * here - second * here).norm() < config_.agree_xy_m &&
         std::abs(normalise_angle(first.yaw_rad - second.yaw_rad)) < config_.agree_yaw_rad;
}

void LoopCloser::close(const GraphEdge& edge) {
  edges_.push_back(edge);
  ++loops_;
}

bool LoopCloser::has_moved() const {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Pose2 moved = drawn_poses_[i].inverse() * poses_[i];
    if (moved.translation().norm() > config_.redraw_xy_m ||
        std::abs(moved.yaw_rad) > config_.redraw_yaw_rad) {
      return true;
    }
  }
  return false;
}

TsdGrid LoopCloser::drawn_layer() {
  TsdGrid layer(place_.geometry());
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    (void)updater_.push(unpacked(i), poses_[i], 1.0, layer);
  }
  drawn_poses_ = poses_;
  redrawn_ = true;
  return layer;
}

}  // namespace lifeline::slam
