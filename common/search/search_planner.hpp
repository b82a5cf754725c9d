#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/search/assign_parts.hpp"

namespace lifeline::search {

/// What is still to be looked at, and where each might go. Shown, never ordered.
struct SearchPlan {
  Parts parts;
  std::vector<Suggestion> suggestions;  ///< by name; who has none can reach nothing that is left
};

/// Makes plans out of a map that grows and helmets that move, for a coordinator or for a helmet's
/// own display: its map's tiles go in as they change, and everybody's places as they are known.
/// Same tiles and places, same parts, distances and suggestions on every machine, but for what was
/// suggested before. One owner, not thread-safe.
class SearchPlanner {
 public:
  explicit SearchPlanner(double map_cell_m) : cells_(map_cell_m) {}

  /// A tile as it is now; nullptr: it is no more.
  void put(TileIndex tile, const sharing::FusedTile* tile_cells) { cells_.put(tile, tile_cells); }

  /// Begins a plan for these. One that was not finished is dropped.
  void begin(std::vector<Seeker> seekers);
  /// Does the next piece of it: the parts, one helmet's ways, or the assignment; each a few
  /// milliseconds. True once, when plan() is new. Tiles may be put between the pieces.
  bool work();
  /// All at once.
  const SearchPlan& make(std::vector<Seeker> seekers);

  [[nodiscard]] const SearchPlan& plan() const { return plan_; }
  [[nodiscard]] const SearchCells& cells() const { return cells_; }
  [[nodiscard]] bool is_at_work() const { return is_at_work_; }

 private:
  void finish();

  SearchCells cells_;
  Travel travel_;
  SearchPlan plan_;
  Parts parts_;
  std::vector<Seeker> seekers_;
  std::vector<std::vector<Reached>> options_;
  std::map<std::string, Eigen::Vector2d> aimed_at_m_;
  bool is_at_work_ = false;
  bool has_parts_ = false;
};

}  // namespace lifeline::search
