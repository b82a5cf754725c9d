#include "agents/slam/map_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
  const std::vector<Place> places =
      rivals_of(view, prediction, find_places(map, view, pieces, prediction, local.T_map_head));
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
  const MatchResult held = judged(view, pose, PoseSource::map, prediction);
  const bool is_walk = prediction.left_open.trace() > 0.0;
  if (!is_walk || held.evidence.inlier_share() >= config_.sure_share) return held;
  // Who stops or turns at once is not where he was expected: the map alone may know better.
  Prediction loose = prediction;
  loose.sigma_xy_m = std::max(loose.sigma_xy_m, config_.surprise_sigma_m);
  const Pose2 free = direct_.align(view, loose);
  const auto likely = [&](const Pose2& T_map_head) {
    return log_likelihood(direct_.agreement(view, T_map_head), T_map_head, loose);
  };
  return likely(free) > likely(pose) ? judged(view, free, PoseSource::map, loose) : held;
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

MapTracker::Place MapTracker::place_at(const TsdView& view, const Pose2& T_map_head,
                                       PoseSource source, const Prediction& prediction) const {
  const double fit = direct_.agreement(view, T_map_head);
  return {T_map_head, source, fit, log_likelihood(fit, T_map_head, prediction)};
}

std::vector<MapTracker::Place> MapTracker::find_places(const WorkingMap& map, const TsdView& view,
                                                       std::span<const SurfacePiece> pieces,
                                                       const Prediction& prediction,
                                                       const Pose2& local) {
  std::vector<Place> places{place_at(view, local, PoseSource::map, prediction)};
  for (const SearchCandidate& candidate : search_.search(map, pieces, prediction)) {
    const Pose2 pose = direct_.align(view, candidate.T_map_head, prediction, kTrialIterations);
    places.push_back(place_at(view, pose, PoseSource::search, prediction));
  }
  return places;
}

std::vector<MapTracker::Place> MapTracker::rivals_of(const TsdView& view,
                                                     const Prediction& prediction,
                                                     std::vector<Place> places) const {
  std::vector<Place> rivals;
  double least = -std::numeric_limits<double>::infinity();
  while (!places.empty() && rivals.size() <= static_cast<std::size_t>(config_.max_rivals)) {
    const auto next =
        std::max_element(places.begin(), places.end(),
                         [](const Place& a, const Place& b) { return a.score < b.score; });
    if (next->score < least) break;
    const bool is_new = std::none_of(rivals.begin(), rivals.end(), [&](const Place& other) {
      const Pose2 apart = other.T_map_head.inverse() * next->T_map_head;
      return apart.translation().norm() < config_.apart_m &&
             std::abs(apart.yaw_rad) < config_.apart_rad;
    });
    // Following the beams costs most of a score: only of places that come next if they lose nothing
    // by it, and that no better one is the same as.
    if (is_new && !next->beams_followed) {
      follow_beams(view, prediction, least, *next);
      continue;
    }
    if (is_new) rivals.push_back(*next);
    places.erase(next);
    least = rivals.front().score - config_.rival_score;
  }
  return rivals;
}

bool MapTracker::needs_search(const MatchResult& local, const Prediction& prediction) const {
  if (prediction.largest_sigma_m() > config_.search_sigma_m) return true;
  if (local.evidence.inlier_share() >= config_.sure_share) return false;
  return local.verdict != Verdict::accepted ||
         prediction.sigma_yaw_rad * config_.lever_m > config_.search_sigma_m;
}

double MapTracker::score(const TsdView& view, const Pose2& T_map_head,
                         const Prediction& prediction) const {
  Place place = place_at(view, T_map_head, PoseSource::map, prediction);
  follow_beams(view, prediction, -std::numeric_limits<double>::infinity(), place);
  return place.score;
}

void MapTracker::follow_beams(const TsdView& view, const Prediction& prediction, double least,
                              Place& place) const {
  // A little more than the share that leaves it `least`.
  const double enough =
      (place.score - least) / (search_.config().independent_points * config_.through_wall) + 1e-6;
  const double share = direct_.seen_through_walls(view, place.T_map_head, enough);
  place.fit -= config_.through_wall * share;
  place.score = log_likelihood(place.fit, place.T_map_head, prediction);
  place.beams_followed = true;
}

double MapTracker::log_likelihood(double fit, const Pose2& T_map_head,
                                  const Prediction& prediction) const {
  return search_.config().independent_points * fit - deviation(T_map_head, prediction);
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
