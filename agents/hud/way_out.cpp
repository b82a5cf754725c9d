#include "agents/hud/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "agents/hud/walkable_floor.hpp"

namespace lifeline::hud {
namespace {

constexpr std::size_t kMostBlocks = 400'000;

/// Straight through b, to a millimetre.
bool goes_on(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, bc = c - b;
  return ab.dot(bc) > 0.0 && std::abs(ab.x() * bc.y() - ab.y() * bc.x()) < 1e-3 * bc.norm();
}

/// A* over blocks, in units of blocks.
class Search {
 public:
  Search(const WalkableFloor& floor, CellIndex start, CellIndex goal) : floor_(floor), goal_(goal) {
    visits_[start] = {0.0, start, false};
    open_.push({guess(start), start});
  }

  /// Blocks from the goal back to the start; empty where there is no way.
  [[nodiscard]] std::vector<CellIndex> run() {
    std::size_t done = 0;
    while (!open_.empty() && done < kMostBlocks) {
      const CellIndex here = open_.top().block;
      open_.pop();
      Visit& visit = visits_.at(here);
      if (visit.done) continue;
      visit.done = true;
      ++done;
      if (here == goal_) return trace();
      expand(here, visit.cost);
    }
    return {};
  }

 private:
  struct Visit {
    double cost = std::numeric_limits<double>::infinity();
    CellIndex from;
    bool done = false;
  };
  struct Open {
    double total;
    CellIndex block;
    bool operator>(const Open& other) const { return total > other.total; }
  };

  [[nodiscard]] double guess(CellIndex block) const {
    return std::hypot(block.x - goal_.x, block.y - goal_.y);
  }

  void expand(CellIndex here, double cost) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{here.x + dx, here.y + dy};
        if ((dx == 0 && dy == 0) || !floor_.allows(here, next)) continue;
        const double total = cost + std::hypot(dx, dy);
        Visit& visit = visits_[next];
        if (visit.done || total >= visit.cost) continue;
        visit = {total, here, false};
        open_.push({total + guess(next), next});
      }
    }
  }

  [[nodiscard]] std::vector<CellIndex> trace() const {
    std::vector<CellIndex> blocks{goal_};
    while (visits_.at(blocks.back()).from != blocks.back())
      blocks.push_back(visits_.at(blocks.back()).from);
    return blocks;
  }

  const WalkableFloor& floor_;
  CellIndex goal_;
  std::unordered_map<CellIndex, Visit, BlockHash> visits_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace

double length_of(const Path& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

std::optional<Path> find_free_way(const HudMap& map, const Path& trail,
                                  const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const WalkableFloor floor(map, trail);
  const auto start = floor.nearest(from_m);
  const auto goal = floor.nearest(to_m);
  if (!start || !goal) return std::nullopt;
  const auto blocks = Search(floor, *start, *goal).run();
  if (blocks.empty()) return std::nullopt;
  Path path{from_m};
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) {
    const Eigen::Vector2d next = floor.point(*block);
    if (path.size() > 1 && goes_on(path[path.size() - 2], path.back(), next)) path.pop_back();
    path.push_back(next);
  }
  path.push_back(to_m);
  return path;
}

Path walk_back(const Path& trail, const Eigen::Vector2d& from_m) {
  Path path{from_m};
  // Always from the earliest point of the trail that lies here: what came between was a detour.
  for (std::size_t behind = trail.size(); behind > 0;) {
    const Eigen::Vector2d here = path.back();
    const auto known = std::find_if(
        trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(behind),
        [&](const Eigen::Vector2d& point) { return (point - here).norm() < kSamePlaceM; });
    const auto earliest = static_cast<std::size_t>(known - trail.begin());
    behind = earliest < behind ? earliest : behind - 1;
    path.push_back(trail[behind]);
  }
  return path;
}

std::optional<WayOut> find_way_out(const HudMap& map, const Path& trail,
                                   const Eigen::Vector2d& from_m) {
  if (trail.empty()) return std::nullopt;
  WayOut way;
  if (auto free = find_free_way(map, trail, from_m, trail.front())) {
    way.points = *std::move(free);
  } else {
    way.points = walk_back(trail, from_m);
    way.by_own_trail = true;
  }
  way.length_m = length_of(way.points);
  return way;
}

Eigen::Vector2d point_ahead(const Path& path, double ahead_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d step = path[i] - path[i - 1];
    if (step.norm() >= ahead_m && ahead_m > 0.0)
      return path[i - 1] + step * (ahead_m / step.norm());
    ahead_m -= step.norm();
  }
  return path.empty() ? Eigen::Vector2d::Zero() : path.back();
}

}  // namespace lifeline::hud
