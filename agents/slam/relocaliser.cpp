#include "agents/slam/relocaliser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agents/slam/submap_chain.hpp"

namespace lifeline::slam {
namespace {

/// How far a place of the search's lattice may be off.
constexpr double kLattice_m = 0.3;
constexpr double kLattice_rad = 0.1;
/// Walls are compared this far around the head.
constexpr double kCompared_m = 12.0;
constexpr std::size_t kMinPoints = 40;
/// So many attempts near to the last known place for one in the whole map.
constexpr int kNearAttempts = 3;
/// A cell this near to a surface is a wall; one beyond the other is free.
constexpr int kWall = TsdCell::kTsdOne * 35 / 100;
constexpr int kFreeTsd = TsdCell::kTsdOne * 95 / 100;

bool is_wall(TsdCell cell) {
  return cell.known() && std::abs(int{cell.tsd}) <= kWall;
}

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
  agreement_ = {};
  outcome_ = AttemptOutcome::nothing;
}

void Relocaliser::end() {
  begin();
  search_.clear();
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
  if (!attempt_is_due()) return std::nullopt;
  if (std::exchange(map_is_stale_, false)) search_.set_map(map);
  const double window_rad = config_.heading_floor_rad + config_.heading_sigmas * heading_sigma_rad;
  RelocalisedPlace best;
  const auto outcome = attempt(map, heading_rad, window_rad, best);
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
  ++scans_since_attempt_;
  if (attempt_stretch_ == stretch_.number() && scans_since_attempt_ < config_.attempt_scans &&
      moved.translation().norm() < config_.attempt_distance_m) {
    return false;
  }
  scans_since_attempt_ = 0;
  attempt_stretch_ = stretch_.number();
  T_stretch_attempt_ = stretch_.T_stretch_head();
  return true;
}

std::optional<AttemptOutcome> Relocaliser::attempt(const WorkingMap& map, double heading_rad,
                                                   double window_rad, RelocalisedPlace& best) {
  cloud_ = stretch_.cloud();
  if (cloud_.size() < kMinPoints) return AttemptOutcome::nothing;
  direct_.set_scan(cloud_);
  if (is_near()) {
    const double way_m = stretch_.T_stretch_head().translation().norm();
    const SearchCircle near{last_->T_map_head.translation(), last_->reach_m + way_m,
                            config_.near_agreement};
    const AttemptOutcome outcome = look_round(map, heading_rad, window_rad, near, best);
    if (outcome != AttemptOutcome::nothing) return outcome;
    // It may be further off after all; but two searches at each attempt would take too long.
    if (++near_in_vain_ % kNearAttempts != 0) return std::nullopt;
  }
  return look_round(map, heading_rad, window_rad, {}, best);
}

AttemptOutcome Relocaliser::look_round(const WorkingMap& map, double heading_rad, double window_rad,
                                       const std::optional<SearchCircle>& near,
                                       RelocalisedPlace& best) {
  std::vector<Eigen::Vector2d> points;
  for (const SurfacePiece& piece : cloud_) points.push_back(piece.point.cast<double>());
  const GlobalSearchResult found = search_.search(points, heading_rad, window_rad, near);
  const double reach_m = reach_of(cloud_);
  std::vector<RelocalisedPlace> places;
  for (const GlobalCandidate& candidate : found.candidates) {
    places.push_back(look_at(map, candidate.T_map_head, reach_m));
  }
  if (near) {
    std::erase_if(places, [&](const RelocalisedPlace& place) {
      return from_last_m(place.T_map_head) > last_->reach_m;
    });
  }
  return judge(std::move(places), found.complete, near ? config_.near : config_.anywhere, best);
}

AttemptOutcome Relocaliser::judge(std::vector<RelocalisedPlace> places, bool complete,
                                  const PlaceDemands& demands, RelocalisedPlace& best) const {
  if (places.empty()) return AttemptOutcome::nothing;
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.quality > b.quality; });
  best = places.front();
  if (!is_good(best, demands)) return AttemptOutcome::nothing;
  if (!complete) return AttemptOutcome::ambiguous;
  if (is_alone(best, places)) return AttemptOutcome::agreed;
  // Of equal places, the one where the helmet was moments ago.
  const double least = best.quality - config_.margin;
  std::erase_if(places, [&](const RelocalisedPlace& place) {
    return place.quality <= least || from_last_m(place.T_map_head) > config_.stayed_m;
  });
  if (places.empty() || !is_good(places.front(), demands) || !is_alone(places.front(), places)) {
    return AttemptOutcome::ambiguous;
  }
  best = places.front();
  return AttemptOutcome::agreed;
}

bool Relocaliser::is_alone(const RelocalisedPlace& place,
                           const std::vector<RelocalisedPlace>& places) const {
  return std::none_of(places.begin(), places.end(), [&](const RelocalisedPlace& other) {
    const Pose2 apart = place.T_map_head.inverse() * other.T_map_head;
    const bool is_other =
        apart.translation().norm() > config_.same_m || std::abs(apart.yaw_rad) > config_.same_rad;
    return is_other && other.quality > place.quality - config_.margin;
  });
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

RelocalisedPlace Relocaliser::look_at(const WorkingMap& map, const Pose2& T_map_head,
                                      double reach_m) {
  const Prediction loose{T_map_head, kLattice_m, kLattice_rad};
  view_.assign(map, T_map_head.translation(), std::max(reach_m, kCompared_m) + 1.0);
  RelocalisedPlace place;
  place.T_map_head = direct_.align(view_, loose);
  place.evidence = direct_.judge(view_, place.T_map_head, loose);
  place.gone_share = gone_share(place.T_map_head);
  place.quality = direct_.agreement(view_, place.T_map_head) - place.gone_share;
  return place;
}

double Relocaliser::gone_share(const Pose2& T_map_head) const {
  const TsdGrid& seen = stretch_.layer();
  const Pose2 T_map_stretch = T_map_head * stretch_.T_stretch_head().inverse();
  const Eigen::Vector2d head = stretch_.T_stretch_head().translation();
  int standing = 0, gone = 0;
  for (const TileIndex tile : seen.tiles()) {
    const CellIndex first = first_cell(tile);
    const TsdTile& cells = *seen.find(tile);
    for (int y = 0; y < kTileSide; y += 2) {
      for (int x = 0; x < kTileSide; x += 2) {
        const TsdCell now = cells[offset_in_tile({x, y})];
        const bool free = now.known() && now.tsd > kFreeTsd;
        if (!free && !is_wall(now)) continue;
        const Eigen::Vector2d p = seen.centre_of({first.x + x, first.y + y});
        if ((p - head).squaredNorm() > kCompared_m * kCompared_m) continue;
        const Pose2 at = view_.to_view({(T_map_stretch * p).x(), (T_map_stretch * p).y(), 0.0});
        const TsdCell then = view_.cell(static_cast<std::int32_t>(std::floor(at.x_m)),
                                        static_cast<std::int32_t>(std::floor(at.y_m)));
        if (!is_wall(then)) continue;
        ++(free ? gone : standing);
      }
    }
  }
  return gone > 0 ? static_cast<double>(gone) / (gone + standing) : 0.0;
}

bool Relocaliser::is_good(const RelocalisedPlace& place, const PlaceDemands& demands) const {
  const MatchEvidence& evidence = place.evidence;
  return evidence.known >= demands.min_known_share * evidence.points &&
         evidence.inlier_share() >= config_.min_inlier_share &&
         evidence.conflicts <= demands.max_conflict_share * evidence.known &&
         place.gone_share <= config_.max_gone_share;
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
