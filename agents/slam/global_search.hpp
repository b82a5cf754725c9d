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
  int max_nodes = 150'000;  ///< bounds the time of one search
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
/// places are bounded all together, row by row. One owner; keeps scratch memory until clear().
class GlobalSearch {
 public:
  explicit GlobalSearch(GlobalSearchConfig config) : config_(config) {}

  /// Takes a map, as it is now: some milliseconds for 1000 m2.
  void set_map(const WorkingMap& map) { field_.assign(map, config_.field); }
  void clear() { field_.clear(); }
  [[nodiscard]] bool has_map() const { return !field_.empty(); }

  /// The places in known free space where a head that sees `points` (head frame) may stand, turned
  /// by `yaw_rad` +- `window_rad`; only in `circle`, if there is one.
  [[nodiscard]] GlobalSearchResult search(std::span<const Eigen::Vector2d> points, double yaw_rad,
                                          double window_rad,
                                          const std::optional<SearchCircle>& circle = {});

 private:
  using Place = FitField::Place;
  /// A block of places at one yaw, and the most that any of them may score.
  struct Node {
    int bound;
    int yaw;
    Place corner;
  };

  [[nodiscard]] bool reaches(Place corner, int side) const;
  void choose_points(std::span<const Eigen::Vector2d> points);
  void turn_points(double yaw_rad);
  void bound_blocks(int yaw, std::vector<Node>& nodes);
  [[nodiscard]] int score(int level, Place corner, int least) const;
  void descend(Place corner, int level, double yaw_rad);
  void note(int score, Place place, double yaw_rad);
  [[nodiscard]] int least_score() const;

  GlobalSearchConfig config_;
  FitField field_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Place> offsets_;  ///< of the turned points from the head
  std::vector<std::int16_t> sums_;
  std::vector<GlobalCandidate> found_;
  std::optional<SearchCircle> circle_;
  int best_ = 0;
  int nodes_left_ = 0;
  bool complete_ = true;
};

}  // namespace lifeline::slam
