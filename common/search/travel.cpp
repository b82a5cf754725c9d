#include "common/search/travel.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::search {

CellId nearest_free(const SearchCells& cells, const Eigen::Vector2d& p_m, int reach) {
  const CellIndex middle{static_cast<std::int32_t>(std::floor(p_m.x() / cells.cell_m())),
                         static_cast<std::int32_t>(std::floor(p_m.y() / cells.cell_m()))};
  CellId best = kNoCell;
  double best_m = 0.0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      const CellId cell = cells.find({middle.x + x, middle.y + y});
      if (cells.at(cell) != Cover::free) continue;
      const double away_m = (cells.centre_m(cell) - p_m).norm();
      if (best != kNoCell && away_m >= best_m) continue;
      best = cell;
      best_m = away_m;
    }
  }
  return best;
}

void Travel::relax(CellId from, CellId to, std::uint32_t cost) {
  if (cost >= cost_[to]) return;
  cost_[to] = cost;
  before_[to] = from;
  waiting_[cost % waiting_.size()].push_back(to);
  ++count_;
}

void Travel::expand(const SearchCells& cells, CellId cell) {
  std::array<CellId, 4> beside{};
  for (int direction = 0; direction < 4; ++direction) {
    const CellId next = cells.neighbour(cell, direction);
    const bool is_free = cells.at(next) == Cover::free;
    beside[static_cast<std::size_t>(direction)] = is_free ? next : kNoCell;
    if (is_free) relax(cell, next, cost_[cell] + kStraight);
  }
  for (int direction = 0; direction < 4; ++direction) {
    const int turn = (direction + 1) % 4;
    const CellId side = beside[static_cast<std::size_t>(direction)];
    if (side == kNoCell || beside[static_cast<std::size_t>(turn)] == kNoCell) continue;
    const CellId corner = cells.neighbour(side, turn);
    if (cells.at(corner) == Cover::free) relax(cell, corner, cost_[cell] + kAcross);
  }
}

Reached Travel::describe(const SearchCells& cells, std::uint32_t part, CellId cell) const {
  Reached reached{part, cell, cost_[cell] * cells.cell_m() / kStraight, {}};
  for (CellId at = cell; at != kNoCell; at = before_[at])
    reached.way_m.push_back(cells.centre_m(at));
  std::ranges::reverse(reached.way_m);
  return reached;
}

std::vector<Reached> Travel::nearest(const SearchCells& cells, const Parts& parts,
                                     const Eigen::Vector2d& from_m, std::size_t most) {
  std::vector<Reached> found;
  if (most == 0 || parts.parts.empty() || !from_m.allFinite()) return found;
  const CellId start = nearest_free(cells, from_m, kStart);
  if (start == kNoCell) return found;
  cost_.assign(cells.size(), kFar);
  before_.resize(cells.size());
  for (auto& bucket : waiting_) bucket.clear();
  count_ = 0;
  std::vector<bool> is_found(parts.parts.size());
  cost_[start] = 0;
  before_[start] = kNoCell;
  waiting_[0].push_back(start);
  ++count_;
  for (std::uint32_t cost = 0; count_ > 0 && found.size() < most; ++cost) {
    auto& bucket = waiting_[cost % waiting_.size()];
    const std::size_t begin = found.size();
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const CellId cell = bucket[i];
      if (cost_[cell] != cost) continue;  // reached by a shorter way meanwhile
      const std::uint32_t part = parts.part_of[cell];
      if (part != kNoPart && !is_found[part]) {
        is_found[part] = true;
        found.push_back(describe(cells, part, cell));
      }
      expand(cells, cell);
    }
    count_ -= bucket.size();
    bucket.clear();
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(begin), found.end(),
              [](const Reached& a, const Reached& b) { return a.part < b.part; });
  }
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace lifeline::search
