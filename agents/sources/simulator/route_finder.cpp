#include "agents/sources/simulator/route_finder.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

/// What a step of one cell costs at this distance from the walls, mm: up to three times its length
/// in a doorway.
std::uint8_t step_cost(double distance_m) {
  constexpr double kComfortableM = 0.75;
  const double lacking = std::max(0.0, kComfortableM - distance_m) / kComfortableM;
  return static_cast<std::uint8_t>(1000.0 * FreeSpace::kCellM * (1.0 + 4.0 * lacking));
}

}  // namespace

RouteFinder::RouteFinder(const FreeSpace& space)
    : straight_cost_(space.size(), 0), columns_(space.columns()), buckets_(kBuckets) {
  for (std::size_t i = 0; i < space.size(); ++i) {
    const CellIndex cell = space.cell(i);
    if (!space.is_walkable(cell)) continue;
    // So every walkable cell has eight neighbours, and no step has to look for the raster's edge.
    LIFELINE_CHECK(cell.x > 0 && cell.y > 0 && cell.x + 1 < space.columns() &&
                   cell.y + 1 < space.rows());
    straight_cost_[i] = step_cost(space.distance_m(cell));
  }
}

void RouteFinder::spread(std::span<const std::size_t> starts,
                         const std::function<bool(std::size_t, double)>& visit) {
  cost_.assign(straight_cost_.size(), kNever);
  from_.resize(straight_cost_.size());
  for (auto& bucket : buckets_) bucket.clear();
  waiting_ = starts.size();
  for (const std::size_t start : starts) {
    cost_[start] = 0;
    from_[start] = static_cast<std::uint32_t>(start);
    buckets_[0].push_back(static_cast<std::uint32_t>(start));
  }
  for (Cost cost = 0; waiting_ > 0; ++cost) {
    auto& bucket = buckets_[cost % kBuckets];
    while (!bucket.empty()) {
      const std::size_t cell = bucket.back();
      bucket.pop_back();
      --waiting_;
      if (cost_[cell] != cost) continue;  // a cheaper way was found meanwhile
      if (!visit(cell, 0.001 * static_cast<double>(cost))) return;
      relax_neighbours(cell);
    }
  }
}

void RouteFinder::forget() {
  cost_ = {};
  from_ = {};
  for (auto& bucket : buckets_) bucket = {};
}

void RouteFinder::relax_neighbours(std::size_t cell) {
  const std::array<std::ptrdiff_t, 8> offsets{
      -1, 1, -columns_, columns_, -columns_ - 1, 1 - columns_, columns_ - 1, columns_ + 1};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::size_t next = cell + static_cast<std::size_t>(offsets[i]);
    if (straight_cost_[next] == 0) continue;
    const Cost step =
        i < 4 ? straight_cost_[next] : straight_cost_[next] * Cost{181} / 128;  // sqrt 2
    const Cost cost = cost_[cell] + step;
    if (cost >= cost_[next]) continue;
    cost_[next] = cost;
    from_[next] = static_cast<std::uint32_t>(cell);
    buckets_[cost % kBuckets].push_back(static_cast<std::uint32_t>(next));
    ++waiting_;
  }
}

std::vector<std::size_t> RouteFinder::way_to(std::size_t cell) const {
  std::vector<std::size_t> way{cell};
  while (from_[way.back()] != way.back()) way.push_back(from_[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

std::size_t RouteFinder::start_of(std::size_t cell) const {
  while (from_[cell] != cell) cell = from_[cell];
  return cell;
}

}  // namespace lifeline::sources
