#include "agents/sources/simulator/doors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "agents/sources/simulator/ray_scene.hpp"

namespace lifeline::sources {
namespace {

constexpr double kNarrowestM = 0.6;
constexpr double kWidestM = 1.3;
constexpr double kStepAsideM = 0.8;  ///< from the middle of a doorway to where rooms have begun
constexpr double kWidensM = 0.6;     ///< by which a room is wider than its doorway
constexpr double kDoorwaysApartM = 1.0;
constexpr int kDirections = 8;  ///< of half a turn

struct Passage {
  Doorway doorway;
  double width_m;
};

/// The passage across `p` along `across`, if `p` lies in the middle of one.
bool passage_at(const RayScene& scene, const Eigen::Vector2d& p, const Eigen::Vector2d& across,
                Passage& found) {
  constexpr double kOffMiddleM = 0.06;
  const double to_left_m = scene.cast(p, across, kWidestM);
  const double to_right_m = scene.cast(p, -across, kWidestM);
  found.width_m = to_left_m + to_right_m;
  if (!(found.width_m >= kNarrowestM && found.width_m <= kWidestM)) return false;
  if (std::abs(to_left_m - to_right_m) > kOffMiddleM) return false;
  const Eigen::Vector2d onwards(-across.y(), across.x());
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector2d ahead = side * onwards;
    if (scene.cast(p, ahead, 2.0 * kStepAsideM) <= kStepAsideM + 0.2) return false;
    const Eigen::Vector2d q = p + kStepAsideM * ahead;
    const double reach_m = found.width_m + kWidensM;
    const double width_m = std::min(scene.cast(q, across, reach_m), reach_m) +
                           std::min(scene.cast(q, -across, reach_m), reach_m);
    if (width_m < reach_m) return false;
  }
  found.doorway = {p + to_left_m * across, p - to_right_m * across};
  return true;
}

Eigen::Vector2d middle(const Doorway& doorway) {
  return 0.5 * (doorway.a + doorway.b);
}

}  // namespace

std::vector<Doorway> find_doorways(const FloorPlan& plan, const FreeSpace& space) {
  const RayScene scene(plan.walls);
  std::vector<Passage> passages;
  for (std::size_t i = 0; i < space.size(); ++i) {
    const CellIndex cell = space.cell(i);
    if (!space.is_walkable(cell) || space.distance_m(cell) > 0.5 * kWidestM) continue;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = std::numbers::pi * k / kDirections;
      Passage passage{};
      if (passage_at(scene, space.centre(cell), {std::cos(angle), std::sin(angle)}, passage)) {
        passages.push_back(passage);
      }
    }
  }
  // The narrowest first: straight across, in the middle of the doorway.
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Passage& a, const Passage& b) { return a.width_m < b.width_m - 1e-6; });
  std::vector<Doorway> doorways;
  for (const Passage& passage : passages) {
    const bool known = std::any_of(doorways.begin(), doorways.end(), [&](const Doorway& other) {
      return (middle(other) - middle(passage.doorway)).norm() < kDoorwaysApartM;
    });
    if (!known) doorways.push_back(passage.doorway);
  }
  return doorways;
}

Doors::Doors(std::vector<Doorway> doorways, When when, std::uint64_t seed)
    : when_(when), draw_(seed) {
  if (when_ == When::never) return;
  for (const Doorway& doorway : doorways) {
    const bool closed = draw_.chance(0.5);
    doors_.push_back({{doorway.a, doorway.b}, doorway.glass, closed, 0.0});
    doors_.back().next_change = draw_.between(0.0, 1.0) * next_time(0.0);
  }
}

double Doors::next_time(double t_s) {
  return t_s + (when_ == When::beside ? draw_.between(2.0, 5.0) : draw_.between(8.0, 25.0));
}

void Doors::advance(double t_s, const Eigen::Vector2d& p_world) {
  closed_.clear();
  closed_glass_.clear();
  for (Door& door : doors_) {
    const double off_m = distance_to(door.leaf, p_world);
    const bool changes = when_ == When::timetable || off_m <= kBesideM;
    if (changes && t_s >= door.next_change) {
      door.wants_closed = !door.wants_closed;
      door.next_change = next_time(t_s);
    }
    if (!door.wants_closed || off_m <= kClearM) continue;
    (door.glass ? closed_glass_ : closed_).push_back(door.leaf);
  }
}

}  // namespace lifeline::sources
