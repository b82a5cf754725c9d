#include "agents/sources/simulator/finds.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

constexpr double kFindsApartM = 2.5;
constexpr int kTries = 200;

std::optional<double> read_number(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// `x,y;x,y`; empty where the text is something else.
std::vector<Eigen::Vector2d> read_places(std::string_view text) {
  std::vector<Eigen::Vector2d> places;
  for (;;) {
    const std::string_view place = text.substr(0, text.find(';'));
    const std::size_t comma = std::min(place.find(','), place.size());
    const auto x_m = read_number(place.substr(0, comma));
    const auto y_m = read_number(place.substr(std::min(comma + 1, place.size())));
    if (!x_m || !y_m || places.size() == FindsWanted::kMost) return {};
    places.emplace_back(*x_m, *y_m);
    if (place.size() == text.size()) return places;
    text.remove_prefix(place.size() + 1);
  }
}

std::vector<Eigen::Vector2d> draw_places(const FreeSpace& space, int count,
                                         const std::vector<Find>& others, Draw& draw) {
  std::vector<std::size_t> walkable;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (space.is_walkable(space.cell(i))) walkable.push_back(i);
  }
  std::vector<Eigen::Vector2d> places;
  const auto is_apart = [&](const Eigen::Vector2d& p) {
    const auto far = [&](const Eigen::Vector2d& other) {
      return (other - p).norm() >= kFindsApartM;
    };
    return std::all_of(places.begin(), places.end(), far) &&
           std::all_of(others.begin(), others.end(),
                       [&](const Find& other) { return far(other.p_world); });
  };
  while (static_cast<int>(places.size()) < count) {
    Eigen::Vector2d p{0.0, 0.0};
    for (int i = 0; i < kTries; ++i) {
      const int drawn = draw.below(static_cast<int>(walkable.size()));
      p = space.centre(space.cell(walkable[static_cast<std::size_t>(drawn)]));
      if (is_apart(p)) break;
    }
    places.push_back(p);
  }
  return places;
}

}  // namespace

Result<FindsWanted> read_finds(const SourceSpec& spec, const std::string& name) {
  const std::string text = spec.text(name, "0");
  FindsWanted wanted;
  if (text.find(',') == std::string::npos) {
    const auto count = spec.integer(name, 0, 0, FindsWanted::kMost);
    if (!count) return forward_error(count);
    wanted.count = static_cast<int>(*count);
    return wanted;
  }
  wanted.places = read_places(text);
  if (!wanted.places.empty()) return wanted;
  return fail(
      ErrorCode::wrong_use,
      "{}: option {}={} is neither a number nor up to {} places of the form x,y;x,y (metres)",
      spec.kind, name, text, FindsWanted::kMost);
}

Result<std::vector<Find>> place_finds(const FreeSpace& space, const FindsWanted& victims,
                                      const FindsWanted& tags, std::uint64_t seed) {
  std::vector<Find> finds;
  Draw draw(seed);
  for (const auto& [kind, wanted] : {std::pair(sensing::SightedKind::victim, &victims),
                                     std::pair(sensing::SightedKind::uwb_tag, &tags)}) {
    for (const Eigen::Vector2d& p : wanted->places) {
      if (!space.is_floor(space.cell_at(p))) {
        return fail(ErrorCode::wrong_use, "sim: a {} at {:.2f},{:.2f} would not lie on the floor",
                    kind == sensing::SightedKind::victim ? "victim" : "tag", p.x(), p.y());
      }
    }
    const auto places =
        wanted->places.empty() ? draw_places(space, wanted->count, finds, draw) : wanted->places;
    for (const Eigen::Vector2d& p : places) finds.push_back({kind, p});
  }
  return finds;
}

const SimulatedDetector::Model& SimulatedDetector::model_of(sensing::SightedKind kind) {
  static constexpr Model kVictim{.range_m = 8.0,
                                 .seen_share = 0.8,
                                 .range_sigma_m = 0.05,
                                 .range_sigma = 0.01,
                                 .bearing_sigma_rad = 1.0 * kDegree,
                                 .confidence_near = 0.9,
                                 .confidence_far = 0.5};
  static constexpr Model kTag{.range_m = 10.0,
                              .seen_share = 0.9,
                              .range_sigma_m = 0.10,
                              .range_sigma = 0.0,
                              .bearing_sigma_rad = 2.0 * kDegree,
                              .confidence_near = 0.95,
                              .confidence_far = 0.8};
  return kind == sensing::SightedKind::victim ? kVictim : kTag;
}

std::vector<sensing::Sighting> SimulatedDetector::look(const RayScene& scene,
                                                       const Pose2& T_world_head,
                                                       std::span<const WallSegment> more_walls) {
  std::vector<sensing::Sighting> sightings;
  for (const Find& find : finds_) {
    // Drawn for every find, seen or not, so that one's fate does not shift the others' noise.
    const double range_noise = noise_.next(), bearing_noise = noise_.next();
    const Model& model = model_of(find.kind);
    const bool noticed = luck_.uniform() < model.seen_share;
    const Eigen::Vector2d way = find.p_world - T_world_head.translation();
    const double range_m = way.norm();
    if (!noticed || range_m > model.range_m || range_m <= 0.0) continue;
    const Eigen::Vector2d direction = way / range_m;
    double wall_m = scene.cast(T_world_head.translation(), direction, range_m);
    for (const WallSegment& wall : more_walls) {
      wall_m = std::min(wall_m, ray_to_wall(T_world_head.translation(), direction, wall));
    }
    if (wall_m < range_m) continue;
    const double range_sigma_m = model.range_sigma_m + model.range_sigma * range_m;
    const double bearing_rad = std::atan2(way.y(), way.x()) - T_world_head.yaw_rad +
                               model.bearing_sigma_rad * bearing_noise;
    const double measured_m = std::max(range_m + range_sigma_m * range_noise, 0.0);
    sightings.push_back({find.kind,
                         {measured_m * std::cos(bearing_rad), measured_m * std::sin(bearing_rad)},
                         std::max(range_sigma_m, model.bearing_sigma_rad * range_m),
                         model.confidence_near + (model.confidence_far - model.confidence_near) *
                                                     range_m / model.range_m});
  }
  return sightings;
}

}  // namespace lifeline::sources
