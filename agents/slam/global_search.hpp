#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/fit_field.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::slam {

struct GlobalSearchConfig {
  int max_points = 128;
  FitFieldConfig field{};
  double min_agreement = 0.5;  ///< poses that agree less are not looked for
  double margin = 0.15;        ///< nor those that agree this much less than the best
  double apart_m = 0.4;        ///< nearer poses are the same place ...
  double apart_rad = 0.15;     ///< ... if they are turned alike
  std::size_t max_candidates = 12;
  int max_nodes = 150'000;  ///< bounds the work of one search
};

/// A pose on the search's lattice, and the mean agreement of the points there: 1 on surfaces, 0 in
/// the unknown, below 0 in space known as free.
struct GlobalCandidate {
  Pose2 T_map_head;
  double agreement = 0.0;
};

/// A circle in map that the head must be in. A search so small can afford to look for places that
/// the map knows only in part.
struct SearchCircle {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double min_agreement = 0.0;  ///< instead of the whole map's
};

/// What a search found.
struct GlobalSearchResult {
  std::vector<GlobalCandidate> candidates;  ///< distinct, best first
  /// False where there were more places worth a look than could be looked at: the candidates tell
  /// nothing of the rest.
  bool complete = true;
};

/// Finds where in a map some points fit, with no idea of where that may be: branch and bound over
/// position and heading (Olson 2009; Hess et al. 2016, section V), on a field that says how well a
/// point fits a place, with the maximum of each block of places as the bound. Blocks of 8 x 8
/// places are bounded all together, row by row. What it finds does not depend on how the work is
/// divided. One owner; keeps scratch memory until clear().
class GlobalSearch {
 public:
  explicit GlobalSearch(GlobalSearchConfig config) : config_(config) {}

  /// Begins to take a map; advance_map() does it, as FitField::advance(). Before a search.
  void begin_map(const WorkingMap& map) { field_.begin(map, config_.field); }
  [[nodiscard]] bool advance_map(const WorkingMap& map, SearchWork& work) {
    return field_.advance(map, work);
  }
  void clear();
  [[nodiscard]] bool has_map() const { return !field_.empty(); }

  /// Begins to look for the places in known free space where a head that sees `points` (head frame;
  /// none further off than the field reaches counts) may stand, turned by `yaw_rad` +-
  /// `window_rad`; only in `circle`, if there is one.
  void begin(std::span<const Eigen::Vector2d> points, double yaw_rad, double window_rad,
             const std::optional<SearchCircle>& circle = {});
  /// Goes on until the search is done or no work is left. Whether it is done.
  [[nodiscard]] bool advance(SearchWork& work);
  /// What the search found that is done.
  [[nodiscard]] GlobalSearchResult result() const { return {found_, complete_}; }

 private:
  using Place = FitField::Place;
  /// A block of places at one yaw, and the most that any of them may score.
  struct Node {
    std::int32_t block;
    std::int16_t bound;
    std::int16_t yaw;
  };

  [[nodiscard]] bool reaches(Place corner, int side) const;
  void choose_points(std::span<const Eigen::Vector2d> points);
  [[nodiscard]] double yaw_of(int yaw) const { return middle_yaw_rad_ + yaw * yaw_step_rad_; }
  void turn_points(int yaw);
  void bound_blocks(int yaw, SearchWork& work);
  void dive(Place corner);
  void thin_nodes();
  void order_nodes(SearchWork& work);
  [[nodiscard]] int score(int level, Place corner, int least);
  void descend(Place corner, int level, double yaw_rad);
  void note(int score, Place place, double yaw_rad);
  void finish();
  [[nodiscard]] int least_score() const { return least_score(best_); }
  /// The least that counts beside a place of so much.
  [[nodiscard]] int least_score(int best) const;

  GlobalSearchConfig config_;
  FitField field_;
  std::vector<Eigen::Vector2d> points_;
  std::optional<SearchCircle> circle_;
  FitField::Blocks among_{};
  double middle_yaw_rad_ = 0.0;
  double yaw_step_rad_ = 0.0;
  int last_yaw_ = 0;  ///< yaws are counted from -last_yaw_ to last_yaw_

  enum class Stage { bounding, descending, done } stage_ = Stage::done;
  int next_yaw_ = 0;
  int turned_yaw_ = 0;          ///< of offsets_
  std::vector<Place> offsets_;  ///< of the turned points from the head
  std::vector<FitField::BlockBound> bounds_;
  std::vector<Node> nodes_;
  std::size_t next_node_ = 0;
  int sure_ = 0;  ///< some place scores so much: known while blocks are bounded
  int best_ = 0;
  int nodes_left_ = 0;
  SearchWork looks_ = 0;  ///< at fits, not counted as work yet
  std::vector<GlobalCandidate> found_;
  bool complete_ = true;
};

}  // namespace lifeline::slam
