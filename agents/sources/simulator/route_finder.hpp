#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "agents/sources/simulator/free_space.hpp"

namespace lifeline::sources {

/// Shortest ways over the walkable cells, where going close to walls costs more. Cells are named by
/// FreeSpace::index(). Integer costs: the same ways on every machine.
class RouteFinder {
 public:
  explicit RouteFinder(const FreeSpace& space);

  /// Spreads from `starts` in order of growing cost and calls visit(cell, cost) for every cell
  /// once; stops when that returns false. Costs are metres in open space.
  void spread(std::span<const std::size_t> starts,
              const std::function<bool(std::size_t, double)>& visit);

  /// Frees what the last spread() found: as much as the floor is large.
  void forget();

  /// The way that the last spread() found to a cell it has visited: from a start to the cell.
  [[nodiscard]] std::vector<std::size_t> way_to(std::size_t cell) const;
  /// Which of the last spread()'s starts a cell it has visited was reached from.
  [[nodiscard]] std::size_t start_of(std::size_t cell) const;

 private:
  using Cost = std::uint32_t;  // millimetres
  /// More than any single step costs: the cells to be visited next fit into a ring of so many
  /// buckets, one for each cost.
  static constexpr std::size_t kBuckets = 512;

  void relax_neighbours(std::size_t cell);

  std::vector<std::uint8_t> straight_cost_;  // of a step into the cell; 0 = not walkable
  std::ptrdiff_t columns_;
  std::vector<Cost> cost_;
  std::vector<std::uint32_t> from_;
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::size_t waiting_ = 0;  // entries in all buckets
};

}  // namespace lifeline::sources
