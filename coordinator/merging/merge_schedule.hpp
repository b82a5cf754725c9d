#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// When maps are matched.
struct MergeScheduleConfig {
  double min_explored_percent = 3.0;  ///< beta of Eq. 11
  double area_x_m = 30.0;             ///< gridx of Eq. 11, as a length
  double area_y_m = 30.0;             ///< gridy of Eq. 11, as a length
  double rematch_growth_percent = 10.0;
};

/// What the schedule looks at of one layer.
struct LayerProgress {
  LayerKey layer;
  std::size_t known_cells = 0;  ///< free or occupied
  bool finished = false;        ///< its helmet maps no more: match once more on the final map
  std::size_t changes = 0;      ///< grows with every tile received
};

/// Decides which pair is matched next: Eq. 11 for both maps, same floor, and enough growth since
/// the pair's last match.
class MergeSchedule {
 public:
  MergeSchedule(MergeScheduleConfig config, double cell_size_m)
      : config_(config), cell_size_m_(cell_size_m) {}

  /// Eq. 11: the explored share of the mission area, in percent.
  [[nodiscard]] double explored_percent(std::size_t known_cells) const;

  /// The pair that waited longest for a match, if any is due.
  [[nodiscard]] std::optional<LayerPair> due(const std::vector<LayerProgress>& layers) const;

  /// Notes that a pair was matched on maps of this progress.
  void matched(const LayerProgress& a, const LayerProgress& b);

 private:
  struct Last {
    std::size_t known_a = 0, known_b = 0;
    std::size_t changes_a = 0, changes_b = 0;
    std::size_t turn = 0;
  };
  [[nodiscard]] bool is_due(const LayerProgress& a, const LayerProgress& b, const Last& last) const;

  MergeScheduleConfig config_;
  double cell_size_m_;
  std::map<LayerPair, Last> last_;
  std::size_t turn_ = 0;
};

}  // namespace lifeline::merging
