#pragma once

#include <set>
#include <string>
#include <vector>

#include "common/search/search_planner.hpp"
#include "common/search/who_searched.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::dashboard {

/// What is left to be searched of a coordinator's common map, who searched what, and where each
/// helmet might go: a plan a second while somebody looks, made in pieces of a few milliseconds so
/// that the coordinator does not wait for it. In the coordinator's thread.
class SearchHelp {
 public:
  explicit SearchHelp(const Coordinator& coordinator);

  /// A tile of the common map changed or vanished.
  void mark(TileIndex tile) { marked_.insert(tile); }
  /// A tile of a helmet's own layer changed.
  void note(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells);

  /// A new plan is due.
  void refresh() { plan_due_ = {}; }

  /// Does a piece of the work. True: there is a new plan, and frame() tells of it.
  [[nodiscard]] bool step(SteadyTime now, bool is_watched);
  /// A ServerFrame of idl/dashboard.proto, in its bytes.
  [[nodiscard]] std::string frame() const;

 private:
  void follow_map();

  const Coordinator& coordinator_;
  search::SearchPlanner planner_;
  search::WhoSearched who_;
  std::set<TileIndex> marked_;
  SteadyTime plan_due_{};
};

}  // namespace lifeline::dashboard
