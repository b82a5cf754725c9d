#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/route_finder.hpp"

namespace lifeline::sources {

/// Which of several walkers someone is.
struct WalkerNumber {
  static constexpr int kMost = 16;

  std::uint64_t seed = 1;  ///< of all walks together
  int walker = 0;          ///< from 0; each begins elsewhere and goes round in another order
  int walkers = 1;         ///< how many share the floor among them; 1 = each walks all of it
};

/// In what order a walker goes to see every place of the floor.
///
/// Places are cells such that every walkable cell is within sight of one, 2.6 m off at most.
/// Walkers begin as far as possible from each other. With several walkers each has the places that
/// are nearest to its own start, plus those along the ways between all starts, which they share.
/// The next place is always about the nearest that has not been seen.
class Tour {
 public:
  /// `space` has to outlive the tour. 0 <= walker < kMost, 1 <= walkers <= kMost.
  Tour(const FreeSpace& space, const WalkerNumber& number);

  [[nodiscard]] std::size_t start() const { return here_; }

  /// The ways of the next round, each from where the one before ends: the walker's own places
  /// first, then the others', then all of them again and again.
  [[nodiscard]] std::vector<std::vector<std::size_t>> next_round();

 private:
  struct Place {
    std::size_t cell;
    bool own;
    bool pending;
    double detour;  // how many times its way counts, drawn anew in every round
  };

  void choose_starts(const WalkerNumber& number);
  void choose_places(Draw& draw);
  void choose_own(const WalkerNumber& number);
  [[nodiscard]] std::vector<bool> near_ways_between_starts();
  [[nodiscard]] std::vector<std::size_t> way_to_next_place();
  void mark_seen_from(std::size_t cell);
  /// The place at a cell; nullptr where there is none.
  [[nodiscard]] Place* place_at(std::size_t cell);

  const FreeSpace& space_;
  RouteFinder routes_;
  Draw draw_;
  std::vector<std::size_t> starts_;
  std::vector<Place> places_;
  std::vector<bool> is_place_;  // by cell
  std::unordered_map<std::size_t, std::size_t> place_at_;
  std::size_t here_ = 0;
  int round_ = 0;
};

}  // namespace lifeline::sources
