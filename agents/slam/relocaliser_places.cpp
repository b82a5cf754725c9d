// How Relocaliser judges the places that its searches find.
#include <algorithm>
#include <cmath>
#include <utility>

#include "agents/slam/relocaliser.hpp"
#include "common/grid/point_transform.hpp"

namespace lifeline::slam {
namespace {

/// How far a place of the search's lattice may be off.
constexpr double kLattice_m = 0.3;
constexpr double kLattice_rad = 0.1;
/// Walls are compared this far around the head.
constexpr double kCompared_m = 12.0;
/// A cell this near to a surface is a wall; one beyond the other is free.
constexpr int kWall = TsdCell::kTsdOne * 35 / 100;
constexpr int kFreeTsd = TsdCell::kTsdOne * 95 / 100;

bool is_wall(TsdCell cell) {
  return cell.known() && std::abs(int{cell.tsd}) <= kWall;
}

}  // namespace

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

/// What the stretch knows around the head, for gone_share().
void Relocaliser::note_seen() {
  seen_.clear();
  const TsdGrid& layer = stretch_.layer();
  const Eigen::Vector2d head = stretch_.T_stretch_head().translation();
  for (const TileIndex tile : layer.tiles()) {
    const CellIndex first = first_cell(tile);
    const TsdTile& cells = *layer.find(tile);
    for (int y = 0; y < kTileSide; y += 2) {
      for (int x = 0; x < kTileSide; x += 2) {
        const TsdCell now = cells[offset_in_tile({x, y})];
        const bool is_free = now.known() && now.tsd > kFreeTsd;
        if (!is_free && !is_wall(now)) continue;
        const CellIndex index{first.x + x, first.y + y};
        if ((layer.centre_of(index) - head).squaredNorm() > kCompared_m * kCompared_m) continue;
        seen_.push_back({index, is_free});
      }
    }
  }
}

double Relocaliser::gone_share(const Pose2& T_map_head) const {
  const PointTransform T_map_stretch(T_map_head * stretch_.T_stretch_head().inverse());
  int standing = 0, gone = 0;
  for (const auto& [index, is_free] : seen_) {
    const Eigen::Vector2d p_map = T_map_stretch * stretch_.layer().centre_of(index);
    const Pose2 at = view_.to_view({p_map.x(), p_map.y(), 0.0});
    const TsdCell then = view_.cell(static_cast<std::int32_t>(std::floor(at.x_m)),
                                    static_cast<std::int32_t>(std::floor(at.y_m)));
    if (!is_wall(then)) continue;
    ++(is_free ? gone : standing);
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

}  // namespace lifeline::slam
