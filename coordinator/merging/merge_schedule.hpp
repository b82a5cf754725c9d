#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "common/base/time.hpp"
#include "coordinator/merging/merge_graph.hpp"

namespace lifeline::merging {

/// When maps are matched.
struct MergeScheduleConfig {
  double min_explored_percent = 3.0;  ///< beta of Eq. 11
  double area_x_m = 30.0;             ///< gridx of Eq. 11, as a length
  double area_y_m = 30.0;             ///< gridy of Eq. 11, as a length
  double rematch_growth_percent = 10.0;
  /// A pair is matched again when so much of a map's wall is no longer where it was.
  double rematch_revised_percent = 3.0;
  Duration min_interval = std::chrono::seconds(1);  ///< between two matches of one pair
};

/// What the schedule looks at of one layer.
struct LayerProgress {
  LayerKey layer;
  std::size_t known_cells = 0;    ///< free or occupied
  bool finished = false;          ///< its helmet maps no more: match once more on the final map
  std::size_t changes = 0;        ///< grows with every tile received
  std::size_t wall_cells = 0;     ///< cells near a wall
  std::size_t revised_cells = 0;  ///< grows with every such cell that a later tile contradicts
  bool quiet = false;             ///< nothing has changed for a while
  /// The group of the plan that it is in; nothing while it is alone.
  std::optional<std::size_t> group = std::nullopt;
};

/// What the coordinator thinks of a pair after its match.
enum class Standing {
  apart,   ///< not merged
  merged,  ///< by an edge that the directive follows
  doubted  ///< merged, but its last match spoke against that
};

/// Decides which pair is matched next: Eq. 11 for both maps, same floor, and enough growth or
/// correction since the pair's last match. Merges that may do harm come first; then pairs that
/// would bring together what nothing joins yet, those that were never matched before the others;
/// then pairs that are in one group by way of others; then merged ones, which need more growth the
/// more often they were confirmed. Every fourth match goes to whoever has waited longest, so that
/// nobody starves.
class MergeSchedule {
 public:
  MergeSchedule(MergeScheduleConfig config, double cell_size_m)
      : config_(config), cell_size_m_(cell_size_m) {}

  /// Eq. 11: the explored share of the mission area, in percent.
  [[nodiscard]] double explored_percent(std::size_t known_cells) const;

  /// The pair to match now, if any. `asked_for`: pairs that somebody wants looked at whether they
  /// changed or not.
  [[nodiscard]] std::optional<LayerPair> due(const std::vector<LayerProgress>& layers,
                                             SteadyTime now,
                                             const std::set<LayerPair>& asked_for = {}) const;
  /// Some pair is due, or will be once its interval has passed.
  [[nodiscard]] bool pending(const std::vector<LayerProgress>& layers,
                             const std::set<LayerPair>& asked_for = {}) const;

  /// Notes that a pair was matched on maps of this progress, and how it stands now.
  void matched(const LayerProgress& a, const LayerProgress& b, SteadyTime now, Standing standing);

 private:
  enum class Need { harm, first, apart, together, merged };
  struct Last {
    LayerProgress a, b;
    SteadyTime at;
    std::size_t turn = 0;
    Standing standing = Standing::apart;
    int confirmed = 0;  ///< matches in a row after which the pair was merged
  };
  struct Candidate {
    LayerPair pair;
    Need need;
    std::size_t turn;  ///< of its last match; 0 = never
    bool rested;       ///< the interval since its last match has passed
  };
  [[nodiscard]] std::vector<Candidate> candidates(const std::vector<LayerProgress>& layers,
                                                  std::optional<SteadyTime> now,
                                                  const std::set<LayerPair>& asked_for) const;
  [[nodiscard]] std::optional<Need> need(const LayerProgress& a, const LayerProgress& b,
                                         const Last& last) const;
  [[nodiscard]] bool was_revised(const LayerProgress& now, const LayerProgress& then) const;
  [[nodiscard]] double growth_factor(const Last& last) const;

  MergeScheduleConfig config_;
  double cell_size_m_;
  std::map<LayerPair, Last> last_;
  std::size_t turn_ = 0;
};

}  // namespace lifeline::merging
