#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "agents/hud/hud_facts.hpp"
#include "common/search/search_planner.hpp"

namespace lifeline::hud {

/// Where a helmet's wearer might search next (docs/search.md): on the common map, for all of its
/// helmets that are heard, as the commander's page does it, so that both say the same; on the own
/// layer while that is merged with nobody's. A plan a second, in pieces of a few milliseconds. Used
/// by the sharing thread.
class SearchAdvice {
 public:
  explicit SearchAdvice(double cell_size_m) : cell_size_m_(cell_size_m), planner_(cell_size_m) {}

  /// A tile of the common map changed or vanished.
  void mark(TileIndex tile) { marked_.insert(tile); }
  /// Does the next piece of the work.
  void step(const sharing::HelmetSharing& helmet, SteadyTime now);

  /// In the own map frame; empty where nothing is left that can be walked to.
  [[nodiscard]] const std::optional<SearchFacts>& facts() const { return facts_; }

 private:
  void follow_map(const sharing::HelmetSharing& helmet);
  void follow_own_layer(const sharing::HelmetSharing& helmet);
  void take_plan(const sharing::HelmetSharing& helmet);

  double cell_size_m_;
  search::SearchPlanner planner_;
  bool is_common_ = false;  ///< whether the planner has the common map
  std::set<TileIndex> marked_;
  std::map<TileIndex, Revision> own_;  ///< what the planner has of the own layer
  Pose2 T_own_planned_;                ///< where the map lay when the plan was begun
  SteadyTime plan_due_{};
  std::optional<SearchFacts> facts_;
};

}  // namespace lifeline::hud
