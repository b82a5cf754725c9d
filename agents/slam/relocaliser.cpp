#include "agents/slam/relocaliser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agents/slam/submap_chain.hpp"

namespace lifeline::slam {
namespace {

constexpr std::size_t kMinPoints = 40;
/// So many attempts near to the last known place for one in the whole map.
constexpr int kNearAttempts = 3;

}  // namespace

Relocaliser::Relocaliser(RelocaliseConfig config, GridGeometry geometry, PushConfig push,
                         MotionConfig motion, MapTracker tracker, DirectConfig direct)
    : config_(config),
      search_(config.search),
      stretch_(config.stretch, geometry, push, motion, std::move(tracker)),
      direct_(direct) {}

void Relocaliser::begin(std::optional<Whereabouts> last) {
  stretch_.clear();
  last_ = last;
  near_in_vain_ = scans_since_last_ = 0;
  last_stretch_ = stretch_.number() + 1;  // it begins with the next scan
  map_is_stale_ = true;
  attempt_.reset();
  agreement_ = {};
  outcome_ = AttemptOutcome::nothing;
}

void Relocaliser::end() {
  begin();
  search_.clear();
  seen_ = {};
}

std::optional<Pose2> Relocaliser::follow(std::span<const SurfacePiece> pieces,
                                         const MotionPrior& prior) {
  ++scans_since_last_;
  const Pose2 before = stretch_.T_stretch_head();
  if (!stretch_.step(pieces, prior)) return std::nullopt;
  return before.inverse() * stretch_.T_stretch_head();
}

std::optional<RelocalisedPlace> Relocaliser::look(const WorkingMap& map, double heading_rad,
                                                  double heading_sigma_rad) {
  ++scans_since_attempt_;
  if (attempt_ && attempt_->stretch != stretch_.number()) attempt_.reset();
  if (!attempt_ && attempt_is_due()) begin_attempt(heading_rad, heading_sigma_rad);
  if (!attempt_) return std::nullopt;
  RelocalisedPlace best;
  const auto outcome = go_on(map, best);
  if (!outcome) return std::nullopt;
  outcome_ = *outcome;
  if (outcome_ != AttemptOutcome::agreed) {
    agreement_ = {};
    return std::nullopt;
  }
  if (!agrees(best.T_map_head)) return std::nullopt;
  outcome_ = AttemptOutcome::found;
  return best;
}

bool Relocaliser::attempt_is_due() {
  const Pose2 moved = T_stretch_attempt_.inverse() * stretch_.T_stretch_head();
  if (attempt_stretch_ == stretch_.number() && scans_since_attempt_ < config_.attempt_scans &&
      moved.translation().norm() < config_.attempt_distance_m) {
    return false;
  }
  scans_since_attempt_ = 0;
  attempt_stretch_ = stretch_.number();
  T_stretch_attempt_ = stretch_.T_stretch_head();
  return true;
}

void Relocaliser::begin_attempt(double heading_rad, double heading_sigma_rad) {
  take_cloud();
  Attempt attempt;
  attempt.stretch = stretch_.number();
  attempt.scan = scans_since_last_;
  attempt.T_stretch_head = stretch_.T_stretch_head();
  attempt.heading_rad = heading_rad;
  attempt.window_rad = config_.heading_floor_rad + config_.heading_sigmas * heading_sigma_rad;
  for (const SurfacePiece& piece : cloud_) attempt.points.push_back(piece.point.cast<double>());
  if (is_near()) {
    const double way_m = stretch_.T_stretch_head().translation().norm();
    attempt.near = SearchCircle{last_->T_map_head.translation(), last_->reach_m + way_m,
                                config_.near_agreement};
  }
  attempt_ = std::move(attempt);
}

void Relocaliser::take_cloud() {
  cloud_ = stretch_.cloud();
  direct_.set_scan(cloud_);
}

std::optional<AttemptOutcome> Relocaliser::go_on(const WorkingMap& map, RelocalisedPlace& best) {
  SearchWork work = config_.work_per_scan;
  if (attempt_->points.size() < kMinPoints) {
    attempt_.reset();
    return AttemptOutcome::nothing;
  }
  while (search(map, work)) {
    const AttemptOutcome outcome = look_at_found(map, best);
    const bool was_near = attempt_->near.has_value();
    // It may be further off after all; but two searches at each attempt would take too long.
    const bool is_vain = was_near && outcome == AttemptOutcome::nothing;
    if (is_vain && ++near_in_vain_ % kNearAttempts == 0) {
      attempt_->near.reset();
      attempt_->searches = false;
      continue;
    }
    attempt_.reset();
    return is_vain ? std::nullopt : std::optional(outcome);
  }
  return std::nullopt;
}

/// Goes on with the search of the attempt; whether it is done.
bool Relocaliser::search(const WorkingMap& map, SearchWork& work) {
  if (!attempt_->has_map) {
    if (std::exchange(map_is_stale_, false)) search_.begin_map(map);
    if (!search_.advance_map(map, work)) return false;
    attempt_->has_map = true;
  }
  if (!attempt_->searches) {
    search_.begin(attempt_->points, attempt_->heading_rad, attempt_->window_rad, attempt_->near);
    attempt_->searches = true;
  }
  return search_.advance(work);
}

AttemptOutcome Relocaliser::look_at_found(const WorkingMap& map, RelocalisedPlace& best) {
  const GlobalSearchResult found = search_.result();
  Pose2 T_begun_now;
  if (attempt_->scan != scans_since_last_) {
    T_begun_now = attempt_->T_stretch_head.inverse() * stretch_.T_stretch_head();
    take_cloud();
  }
  if (!found.candidates.empty()) note_seen();
  const double reach_m = reach_of(cloud_);
  std::vector<RelocalisedPlace> places;
  for (const GlobalCandidate& candidate : found.candidates) {
    places.push_back(look_at(map, candidate.T_map_head * T_begun_now, reach_m));
  }
  const bool was_near = attempt_->near.has_value();
  if (was_near) {
    std::erase_if(places, [&](const RelocalisedPlace& place) {
      return from_last_m(place.T_map_head) > last_->reach_m;
    });
  }
  return judge(std::move(places), found.complete, was_near ? config_.near : config_.anywhere, best);
}

bool Relocaliser::is_last_known() const {
  return last_ && stretch_.number() == last_stretch_;
}

bool Relocaliser::is_near() const {
  return is_last_known() && last_->reach_m <= config_.near_most_m &&
         scans_since_last_ <= config_.near_scans;
}

double Relocaliser::from_last_m(const Pose2& T_map_head) const {
  if (!is_last_known()) return std::numeric_limits<double>::infinity();
  const Pose2 T_map_first = T_map_head * stretch_.T_stretch_head().inverse();
  return (T_map_first.translation() - last_->T_map_head.translation()).norm();
}

double Relocaliser::way_needed_m(const Pose2& T_map_head) const {
  const double from_last = from_last_m(T_map_head);
  if (from_last <= config_.stayed_m) return 0.0;
  return is_near() && from_last <= last_->reach_m ? config_.near_moved_m : config_.moved_m;
}

bool Relocaliser::agrees(const Pose2& T_map_head) {
  const Pose2& T_stretch_head = stretch_.T_stretch_head();
  const Pose2 T_map_stretch = T_map_head * T_stretch_head.inverse();
  const Pose2 apart = (agreement_.T_map_stretch * T_stretch_head).inverse() * T_map_head;
  const bool same = agreement_.attempts > 0 && agreement_.stretch == stretch_.number() &&
                    apart.translation().norm() <= config_.same_m &&
                    std::abs(apart.yaw_rad) <= config_.same_rad;
  if (!same) agreement_ = {0, stretch_.number(), T_map_stretch, T_stretch_head};
  ++agreement_.attempts;
  agreement_.T_map_stretch = T_map_stretch;
  const Pose2 moved = agreement_.T_stretch_first.inverse() * T_stretch_head;
  return agreement_.attempts >= config_.attempts &&
         moved.translation().norm() >= way_needed_m(T_map_head);
}

}  // namespace lifeline::slam
