#include "agents/sources/simulator/tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

constexpr double kSightM = 2.6;     ///< within which a place stands for the floor around it
constexpr double kPassedByM = 0.6;  ///< from here a place counts as visited
constexpr double kSharedM = 1.5;    ///< from a way between two starts
constexpr double kRoomyM = 0.6;     ///< from the walls: where starts and places are preferred
constexpr double kMostDetour = 1.4;

/// Calls visit(cell) for every walkable cell within `radius_m` of `centre`.
template <typename Visit>
void around(const FreeSpace& space, CellIndex centre, double radius_m, Visit visit) {
  const int reach = static_cast<int>(radius_m / FreeSpace::kCellM);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const CellIndex cell{centre.x + dx, centre.y + dy};
      if (dx * dx + dy * dy <= reach * reach && space.is_walkable(cell)) visit(cell);
    }
  }
}

}  // namespace

Tour::Tour(const FreeSpace& space, const WalkerNumber& number)
    : space_(space),
      routes_(space),
      draw_(stir(stir(number.seed, 2), static_cast<std::uint64_t>(number.walker))),
      is_place_(space.size(), false) {
  LIFELINE_CHECK(number.walker >= 0 && number.walker < WalkerNumber::kMost);
  LIFELINE_CHECK(number.walkers >= 1 && number.walkers <= WalkerNumber::kMost);
  choose_starts(number);
  here_ = starts_[static_cast<std::size_t>(number.walker)];
  choose_places(draw_);
  choose_own(number);
}

/// Farthest points: each start is as far as possible from all before it. Drawn from the seed alone,
/// so that all walkers agree.
void Tour::choose_starts(const WalkerNumber& number) {
  Draw draw(stir(number.seed, 3));
  std::vector<std::uint32_t> walkable;
  for (std::size_t i = 0; i < space_.size(); ++i) {
    if (space_.is_walkable(space_.cell(i))) walkable.push_back(static_cast<std::uint32_t>(i));
  }
  const std::size_t anywhere =
      walkable[static_cast<std::size_t>(draw.below(static_cast<int>(walkable.size())))];
  const auto farthest_from = [&](std::span<const std::size_t> from) {
    std::size_t farthest = from.front(), farthest_roomy = from.front();
    routes_.spread(from, [&](std::size_t cell, double) {
      farthest = cell;
      if (space_.distance_m(space_.cell(cell)) >= kRoomyM) farthest_roomy = cell;
      return true;
    });
    return farthest_roomy == from.front() ? farthest : farthest_roomy;
  };
  starts_.push_back(farthest_from(std::span(&anywhere, 1)));
  const auto count = static_cast<std::size_t>(std::max(number.walkers, number.walker + 1));
  while (starts_.size() < count) starts_.push_back(farthest_from(starts_));
}

void Tour::choose_places(Draw& draw) {
  std::vector<std::uint32_t> roomy, narrow;
  for (std::size_t i = 0; i < space_.size(); ++i) {
    const CellIndex cell = space_.cell(i);
    if (!space_.is_walkable(cell)) continue;
    (space_.distance_m(cell) >= kRoomyM ? roomy : narrow).push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<bool> seen(space_.size());
  for (auto* cells : {&roomy, &narrow}) {
    for (std::size_t i = cells->size(); i > 1; --i) {
      std::swap((*cells)[i - 1],
                (*cells)[static_cast<std::size_t>(draw.below(static_cast<int>(i)))]);
    }
    for (const std::size_t place : *cells) {
      if (seen[place]) continue;
      is_place_[place] = true;
      place_at_[place] = places_.size();
      places_.push_back({place, true, false, 1.0});
      const CellIndex from = space_.cell(place);
      around(space_, from, kSightM, [&](CellIndex cell) {
        const std::size_t i = space_.index(cell);
        if (!seen[i]) seen[i] = space_.can_see(from, cell);
      });
    }
  }
}

void Tour::choose_own(const WalkerNumber& number) {
  if (number.walkers == 1) return;
  const std::vector<bool> shared = near_ways_between_starts();
  routes_.spread(starts_, [](std::size_t, double) { return true; });
  for (Place& place : places_) {
    place.own = routes_.start_of(place.cell) == here_ || shared[place.cell];
  }
}

std::vector<bool> Tour::near_ways_between_starts() {
  std::vector<bool> near(space_.size());
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) {
    routes_.spread(std::span(&starts_[i], 1), [](std::size_t, double) { return true; });
    for (std::size_t j = i + 1; j < starts_.size(); ++j) {
      const std::vector<std::size_t> way = routes_.way_to(starts_[j]);
      for (std::size_t k = 0; k < way.size(); k += 10) {
        const CellIndex from = space_.cell(way[k]);
        around(space_, from, kSharedM, [&](CellIndex cell) {
          const std::size_t index = space_.index(cell);
          if (!near[index]) near[index] = space_.can_see(from, cell);
        });
      }
    }
  }
  return near;
}

std::vector<std::vector<std::size_t>> Tour::next_round() {
  const bool others_left =
      std::any_of(places_.begin(), places_.end(), [](const Place& place) { return !place.own; });
  for (Place& place : places_) {
    place.pending = round_ == 0 ? place.own : round_ > 1 || !others_left || !place.own;
    place.detour = draw_.between(1.0, kMostDetour);
  }
  ++round_;
  std::vector<std::vector<std::size_t>> ways;
  for (mark_seen_from(here_);;) {
    std::vector<std::size_t> way = way_to_next_place();
    if (way.empty()) break;
    for (const std::size_t cell : way) mark_seen_from(cell);
    here_ = way.back();
    ways.push_back(std::move(way));
  }
  routes_.forget();  // until the next round
  return ways;
}

std::vector<std::size_t> Tour::way_to_next_place() {
  double best = std::numeric_limits<double>::infinity();
  const Place* next = nullptr;
  routes_.spread(std::span(&here_, 1), [&](std::size_t cell, double cost) {
    if (cost >= best) return false;
    const Place* place = place_at(cell);
    if (place != nullptr && place->pending && cost * place->detour < best) {
      best = cost * place->detour;
      next = place;
    }
    return true;
  });
  return next == nullptr ? std::vector<std::size_t>{} : routes_.way_to(next->cell);
}

void Tour::mark_seen_from(std::size_t cell) {
  const CellIndex from = space_.cell(cell);
  around(space_, from, kPassedByM, [&](CellIndex near) {
    Place* place = place_at(space_.index(near));
    if (place != nullptr && space_.can_see(from, near)) place->pending = false;
  });
}

Tour::Place* Tour::place_at(std::size_t cell) {
  return is_place_[cell] ? &places_[place_at_.at(cell)] : nullptr;
}

}  // namespace lifeline::sources
