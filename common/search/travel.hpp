#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/search/frontier_parts.hpp"

namespace lifeline::search {

/// A part that can be walked to.
struct Reached {
  std::uint32_t part = 0;
  CellId cell = kNoCell;  ///< of the part, where the way comes to it
  double distance_m = 0.0;
  std::vector<Eigen::Vector2d> way_m;  ///< from the start to that square, in the map's frame
};

/// Ways over free squares: to the side, or across a corner where both squares beside it are free. A
/// step of d squares is 10 d long, across 14 d. Keeps its memory from one search to the next.
class Travel {
 public:
  /// The parts nearest to `from_m`, at most `most`, nearest first (alike ones by number). Starts
  /// at the nearest free square, at most kStart away; nothing where there is none.
  [[nodiscard]] std::vector<Reached> nearest(const SearchCells& cells, const Parts& parts,
                                             const Eigen::Vector2d& from_m, std::size_t most);

  static constexpr int kStart = 5;  ///< squares

 private:
  static constexpr std::uint32_t kStraight = 10, kAcross = 14, kFar = ~std::uint32_t{0};
  void relax(CellId from, CellId to, std::uint32_t cost);
  void expand(const SearchCells& cells, CellId cell);
  [[nodiscard]] Reached describe(const SearchCells& cells, std::uint32_t part, CellId cell) const;

  std::vector<std::uint32_t> cost_;
  std::vector<CellId> before_;
  std::array<std::vector<CellId>, kAcross + 1> waiting_;  ///< by cost, which goes round
  std::size_t count_ = 0;
};

/// The free square nearest to a place, at most `reach` squares away in x and y; kNoCell.
[[nodiscard]] CellId nearest_free(const SearchCells& cells, const Eigen::Vector2d& p_m, int reach);

}  // namespace lifeline::search
