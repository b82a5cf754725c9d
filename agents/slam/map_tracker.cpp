#include "agents/slam/map_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lifeline::slam {
namespace {
/// Enough for a trial to come close; the best one is aligned to the end.
constexpr int kTrialIterations = 6;
}  // namespace

std::vector<ScoredMatch> MapTracker::match(const WorkingMap& map, const TsdView& view,
                                           std::span<const SurfacePiece> pieces,
                                           const Prediction& prediction) {
  const MatchResult local = match_locally(view, pieces, prediction);
  if (!needs_search(local, prediction)) return {{local, 0.0}};

  const StageTimer timer(times_ == nullptr ? nullptr : &times_->search);
  std::vector<Place> places{
      {local.T_map_head, score(view, local.T_map_head, prediction), PoseSource::map}};
  add_places(map, view, pieces, prediction, places);
  keep_rivals(places);
  std::vector<ScoredMatch> matches;
  for (const Place& place : places) {
    const Pose2 pose = direct_.align(view, place.T_map_head, prediction, 2 * kTrialIterations);
    matches.push_back({judged(view, pose, place.source, prediction), place.score});
  }
  for (ScoredMatch& match : matches) match.match.evidence.covariance += spread(matches, match);
  return matches;
}

MatchResult MapTracker::match_locally(const TsdView& view, std::span<const SurfacePiece> pieces,
                                      const Prediction& prediction) {
  const StageTimer timer(times_ == nullptr ? nullptr : &times_->match);
  direct_.set_scan(pieces);
  const Pose2 pose = direct_.align(view, prediction);
  return judged(view, pose, PoseSource::map, prediction);
}

Eigen::Matrix3d MapTracker::spread(const std::vector<ScoredMatch>& matches,
                                   const ScoredMatch& about) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ScoredMatch& rival : matches) {
    const Pose2 &p = rival.match.T_map_head, &q = about.match.T_map_head;
    const Eigen::Vector3d apart(p.x_m - q.x_m, p.y_m - q.y_m,
                                normalise_angle(p.yaw_rad - q.yaw_rad));
    const double likely = std::exp((rival.score - about.score) / config_.rival_doubt);
    sum += std::min(likely, 1.0) * apart * apart.transpose();
  }
  return sum;
}

void MapTracker::add_places(const WorkingMap& map, const TsdView& view,
                            std::span<const SurfacePiece> pieces, const Prediction& prediction,
                            std::vector<Place>& places) {
  double best = places.front().score;
  for (const SearchCandidate& candidate : search_.search(map, pieces, prediction)) {
    const Pose2 pose = direct_.align(view, candidate.T_map_head, prediction, kTrialIterations);
    const double agreement = direct_.agreement(view, pose);
    // Following the beams costs most of a score: not where keep_rivals() will drop the place
    // anyway.
    if (log_likelihood(agreement, pose, prediction) < best - config_.rival_score) continue;
    const double fit = agreement - through_walls(view, pose);
    places.push_back({pose, log_likelihood(fit, pose, prediction), PoseSource::search});
    best = std::max(best, places.back().score);
  }
}

void MapTracker::keep_rivals(std::vector<Place>& places) const {
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.score > b.score; });
  const std::vector<Place> all = std::exchange(places, {});
  for (const Place& place : all) {
    if (place.score < all.front().score - config_.rival_score) break;
    const bool is_new = std::none_of(places.begin(), places.end(), [&](const Place& other) {
      const Pose2 apart = other.T_map_head.inverse() * place.T_map_head;
      return apart.translation().norm() < config_.apart_m &&
             std::abs(apart.yaw_rad) < config_.apart_rad;
    });
    if (is_new) places.push_back(place);
    if (places.size() > static_cast<std::size_t>(config_.max_rivals)) break;
  }
}

bool MapTracker::needs_search(const MatchResult& local, const Prediction& prediction) const {
  if (prediction.sigma_xy_m > config_.search_sigma_m) return true;
  if (local.evidence.inlier_share() >= config_.sure_share) return false;
  return local.verdict != Verdict::accepted ||
         prediction.sigma_yaw_rad * config_.lever_m > config_.search_sigma_m;
}

double MapTracker::score(const TsdView& view, const Pose2& T_map_head,
                         const Prediction& prediction) const {
  const double fit = direct_.agreement(view, T_map_head) - through_walls(view, T_map_head);
  return log_likelihood(fit, T_map_head, prediction);
}

double MapTracker::through_walls(const TsdView& view, const Pose2& T_map_head) const {
  return config_.through_wall * direct_.seen_through_walls(view, T_map_head);
}

double MapTracker::log_likelihood(double fit, const Pose2& T_map_head,
                                  const Prediction& prediction) const {
  const Pose2& expected = prediction.T_map_head;
  const double xy =
      (T_map_head.translation() - expected.translation()).norm() / prediction.sigma_xy_m;
  const double yaw =
      normalise_angle(T_map_head.yaw_rad - expected.yaw_rad) / prediction.sigma_yaw_rad;
  return search_.config().independent_points * fit - 0.5 * (xy * xy + yaw * yaw);
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
