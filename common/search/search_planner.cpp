#include "common/search/search_planner.hpp"

#include <utility>

namespace lifeline::search {

void SearchPlanner::begin(std::vector<Seeker> seekers) {
  seekers_ = std::move(seekers);
  options_.clear();
  is_at_work_ = true;
  has_parts_ = false;
}

bool SearchPlanner::work() {
  if (!is_at_work_) return false;
  if (!has_parts_) {
    parts_ = find_parts(cells_);
    has_parts_ = true;
    return false;
  }
  // Squares of tiles that came since have no part yet.
  parts_.part_of.resize(cells_.size(), kNoPart);
  if (options_.size() < seekers_.size()) {
    // However the others choose, one of so many is left; some more, so that what was suggested
    // before is among them though others came nearer.
    constexpr std::size_t kSpare = 8;
    options_.push_back(travel_.nearest(cells_, parts_, seekers_[options_.size()].p_map_m,
                                       seekers_.size() + kSpare));
    return false;
  }
  finish();
  return true;
}

void SearchPlanner::finish() {
  plan_.suggestions = assign_parts(seekers_, options_, aimed_at_m_, parts_, cells_);
  plan_.parts = std::move(parts_);
  aimed_at_m_.clear();
  for (const Suggestion& suggestion : plan_.suggestions)
    aimed_at_m_[suggestion.id] = cells_.centre_m(suggestion.to.cell);
  is_at_work_ = false;
}

const SearchPlan& SearchPlanner::make(std::vector<Seeker> seekers) {
  begin(std::move(seekers));
  while (!work()) {
  }
  return plan_;
}

}  // namespace lifeline::search
