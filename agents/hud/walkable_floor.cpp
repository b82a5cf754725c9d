#include "agents/hud/walkable_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lifeline::hud {
namespace {

constexpr int kInexactCells = 2;
// Over one cell that is not free, no more: walls are thicker.
constexpr double kBesideCells = 2.5;
constexpr double kLongestStep_m = 3.0;
constexpr int kReachBlocks = 5;

}  // namespace

WalkableFloor::WalkableFloor(const HudMap& map, const std::vector<Eigen::Vector2d>& trail)
    : map_(map) {
  std::optional<Eigen::Vector2d> before_m;
  for (std::size_t i = 1; i < trail.size(); ++i) {
    const Eigen::Vector2d step = trail[i] - trail[i - 1];
    const int pieces = static_cast<int>(std::ceil(step.norm() / map.cell_size_m())) + 1;
    if (step.norm() > kLongestStep_m) {  // not walked: found again elsewhere
      before_m.reset();
      continue;
    }
    for (int piece = 0; piece <= pieces; ++piece)
      add_walked(trail[i - 1] + step * (static_cast<double>(piece) / pieces), before_m);
  }
}

double WalkableFloor::block_size_m() const {
  return HudMap::kBlockCells * map_.cell_size_m();
}

bool WalkableFloor::allows(CellIndex block) const {
  return map_.is_passable(block) || walked_.contains(block);
}

bool WalkableFloor::allows(CellIndex from, CellIndex to) const {
  const bool wide = map_.is_passable(from) && map_.is_passable(to);
  if (wide && (from.x == to.x || from.y == to.y)) return true;
  if (wide && map_.is_passable({to.x, from.y}) && map_.is_passable({from.x, to.y})) return true;
  const auto walked = walked_.find(from);
  return walked != walked_.end() &&
         std::ranges::find(walked->second.on_to, to) != walked->second.on_to.end();
}

Eigen::Vector2d WalkableFloor::point(CellIndex block) const {
  const auto walked = walked_.find(block);
  if (walked != walked_.end()) return walked->second.p_m;
  return Eigen::Vector2d(block.x + 0.5, block.y + 0.5) * block_size_m();
}

std::optional<CellIndex> WalkableFloor::nearest(const Eigen::Vector2d& p_m) const {
  const CellIndex here = cell_at(p_m, block_size_m());
  std::optional<CellIndex> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int dy = -kReachBlocks; dy <= kReachBlocks; ++dy) {
    for (int dx = -kReachBlocks; dx <= kReachBlocks; ++dx) {
      const CellIndex block{here.x + dx, here.y + dy};
      const double away = std::hypot(dx, dy);
      if (away >= least || !allows(block)) continue;
      least = away;
      nearest = block;
    }
  }
  return nearest;
}

/// The trail is not exact to a cell: the free cell nearest to where it says that one walked.
std::optional<Eigen::Vector2d> WalkableFloor::free_near(const Eigen::Vector2d& p_m) const {
  const CellIndex here = cell_at(p_m, map_.cell_size_m());
  std::optional<Eigen::Vector2d> nearest;
  for (int dy = -kInexactCells; dy <= kInexactCells; ++dy) {
    for (int dx = -kInexactCells; dx <= kInexactCells; ++dx) {
      const CellIndex cell{here.x + dx, here.y + dy};
      if (map_.at(cell) != Occupancy::free) continue;
      const Eigen::Vector2d middle_m =
          Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5) * map_.cell_size_m();
      if (!nearest || (middle_m - p_m).norm() < (*nearest - p_m).norm()) nearest = middle_m;
    }
  }
  return nearest;
}

void WalkableFloor::add_walked(const Eigen::Vector2d& trail_m,
                               std::optional<Eigen::Vector2d>& before_m) {
  const auto free_m = free_near(trail_m);
  if (free_m) {
    const CellIndex block = cell_at(*free_m, block_size_m());
    walked_.try_emplace(block, Walked{*free_m, {}});
    // Between its points, and where the map has another mind by now (drift, a door that shut), the
    // trail may cross a wall, with free cells nearest to it on either side: no way leads through.
    if (before_m && (*free_m - *before_m).norm() < kBesideCells * map_.cell_size_m())
      join(cell_at(*before_m, block_size_m()), block);
  }
  before_m = free_m;
}

void WalkableFloor::join(CellIndex a, CellIndex b) {
  if (a == b) return;
  auto& from_b = walked_.at(b).on_to;
  if (std::ranges::find(from_b, a) != from_b.end()) return;
  from_b.push_back(a);
  walked_.at(a).on_to.push_back(b);
}

}  // namespace lifeline::hud
