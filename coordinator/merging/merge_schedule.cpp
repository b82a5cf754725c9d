#include "coordinator/merging/merge_schedule.hpp"

namespace lifeline::merging {

double MergeSchedule::explored_percent(std::size_t known_cells) const {
  const double gridx = config_.area_x_m / cell_size_m_, gridy = config_.area_y_m / cell_size_m_;
  return 100.0 * static_cast<double>(known_cells) / (gridx * gridy);
}

std::optional<LayerPair> MergeSchedule::due(const std::vector<LayerProgress>& layers) const {
  std::optional<LayerPair> longest_waiting;
  std::size_t oldest_turn = 0;
  for (const LayerProgress& a : layers) {
    for (const LayerProgress& b : layers) {
      if (!(a.layer < b.layer) || a.layer.floor != b.layer.floor) continue;
      if (explored_percent(a.known_cells) <= config_.min_explored_percent ||
          explored_percent(b.known_cells) <= config_.min_explored_percent) {
        continue;
      }
      const LayerPair pair{a.layer, b.layer};
      const auto last = last_.find(pair);
      if (last != last_.end() && !is_due(a, b, last->second)) continue;
      const std::size_t turn = last == last_.end() ? 0 : last->second.turn;
      if (!longest_waiting || turn < oldest_turn) {
        longest_waiting = pair;
        oldest_turn = turn;
      }
    }
  }
  return longest_waiting;
}

bool MergeSchedule::is_due(const LayerProgress& a, const LayerProgress& b, const Last& last) const {
  if (a.finished && b.finished && (a.changes != last.changes_a || b.changes != last.changes_b))
    return true;
  const double factor = 1.0 + config_.rematch_growth_percent / 100.0;
  return static_cast<double>(a.known_cells) > factor * static_cast<double>(last.known_a) ||
         static_cast<double>(b.known_cells) > factor * static_cast<double>(last.known_b);
}

void MergeSchedule::matched(const LayerProgress& a, const LayerProgress& b) {
  last_[{a.layer, b.layer}] = {a.known_cells, b.known_cells, a.changes, b.changes, ++turn_};
}

}  // namespace lifeline::merging
