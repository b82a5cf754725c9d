#include "common/search/frontier_parts.hpp"

#include <algorithm>
#include <utility>

namespace lifeline::search {
namespace {

constexpr int kPartSide = kPartTiles * kBlockSide;
constexpr double kLongestStep = 2.1;  ///< squares: further apart, a new line begins

CellIndex region_of(CellIndex place) {
  const auto floor_divide = [](int a) {
    return a >= 0 ? a / kPartSide : -((-a - 1) / kPartSide) - 1;
  };
  return {floor_divide(place.x), floor_divide(place.y)};
}

// The eight around a square, corners by way of either side that is there.
std::array<CellId, 8> around(const SearchCells& cells, CellId cell) {
  std::array<CellId, 8> all{};
  for (int direction = 0; direction < 4; ++direction) {
    const auto i = static_cast<std::size_t>(direction);
    const int next = (direction + 1) % 4;
    const CellId beside = cells.neighbour(cell, direction);
    const CellId other = cells.neighbour(cell, next);
    all[i] = beside;
    all[i + 4] = beside != kNoCell
                     ? cells.neighbour(beside, next)
                     : (other != kNoCell ? cells.neighbour(other, direction) : kNoCell);
  }
  return all;
}

Part collect(const SearchCells& cells, CellId first, std::vector<std::uint32_t>& waiting) {
  constexpr std::uint32_t kWaiting = 0;
  Part part;
  const CellIndex region = region_of(cells.place(first));
  waiting[first] = kNoPart;
  part.cells.push_back(first);
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    for (const CellId next : around(cells, part.cells[i])) {
      if (next == kNoCell || waiting[next] != kWaiting) continue;
      if (region_of(cells.place(next)) != region) continue;
      waiting[next] = kNoPart;
      part.cells.push_back(next);
    }
  }
  std::ranges::sort(part.cells, {}, [&](CellId cell) { return cells.place(cell); });
  return part;
}

// Whether the unknown beside it goes on.
bool leads_on(const SearchCells& cells, const Part& part) {
  std::vector<CellId> unknown;
  const auto take = [&](CellId cell) {
    if (cells.at(cell) == Cover::unknown && std::ranges::find(unknown, cell) == unknown.end())
      unknown.push_back(cell);
    return cell == kNoCell;  // beyond all tiles
  };
  for (const CellId cell : part.cells) {
    for (int direction = 0; direction < 4; ++direction)
      if (take(cells.neighbour(cell, direction)) || unknown.size() >= kLeastUnknown) return true;
  }
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    for (int direction = 0; direction < 4; ++direction)
      if (take(cells.neighbour(unknown[i], direction)) || unknown.size() >= kLeastUnknown)
        return true;
  }
  return false;
}

}  // namespace

Parts find_parts(SearchCells& cells) {
  Parts found;
  const std::vector<CellId> frontier = cells.frontier();
  found.part_of.assign(cells.size(), kNoPart);
  for (const CellId cell : frontier) found.part_of[cell] = 0;
  for (const CellId cell : frontier) {
    if (found.part_of[cell] == kNoPart) continue;
    Part part = collect(cells, cell, found.part_of);
    if (part.cells.size() >= kLeastCells && leads_on(cells, part))
      found.parts.push_back(std::move(part));
  }
  std::ranges::sort(found.parts, {},
                    [&](const Part& part) { return cells.place(part.cells.front()); });
  for (std::uint32_t number = 0; number < found.parts.size(); ++number)
    for (const CellId cell : found.parts[number].cells) found.part_of[cell] = number;
  return found;
}

std::vector<std::vector<Eigen::Vector2d>> outline_m(const Part& part, const SearchCells& cells) {
  std::vector<Eigen::Vector2d> left;
  for (const CellId cell : part.cells) left.push_back(cells.centre_m(cell));
  std::vector<std::vector<Eigen::Vector2d>> lines;
  while (!left.empty()) {
    auto next = left.begin();
    if (!lines.empty()) {
      const Eigen::Vector2d end = lines.back().back();
      next = std::ranges::min_element(left, {}, [&](const auto& p) { return (p - end).norm(); });
    }
    if (lines.empty() || (*next - lines.back().back()).norm() > kLongestStep * cells.cell_m())
      lines.emplace_back();
    lines.back().push_back(*next);
    left.erase(next);
  }
  return lines;
}

}  // namespace lifeline::search
