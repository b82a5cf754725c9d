#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/slam/working_map.hpp"
#include "common/grid/pose2.hpp"

namespace lifeline::slam {

struct GlobalSearchConfig {
  int max_points = 128;
  double spacing_m = 0.1;  ///< of the field; doubled until all of the map fits max_cells
  std::size_t max_cells = std::size_t{1} << 21U;
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
  void set_map(const WorkingMap& map);
  void clear();
  [[nodiscard]] bool has_map() const { return !fit_[0].empty(); }

  /// The places in known free space where a head that sees `points` (head frame) may stand, turned
  /// by `yaw_rad` +- `window_rad`.
  [[nodiscard]] GlobalSearchResult search(std::span<const Eigen::Vector2d> points, double yaw_rad,
                                          double window_rad);

 private:
  static constexpr int kLevels = 4;  ///< blocks of 1, 2, 4, 8 places a side
  static constexpr int kBlock = 1 << (kLevels - 1);

  struct Place {
    std::int32_t column, row;
  };
  /// A block of places at one yaw, and the most that any of them may score.
  struct Node {
    int bound;
    int yaw;
    Place corner;
  };

  void lay_out(const WorkingMap& map);
  void fill_fit(const WorkingMap& map);
  void fill_tile(const TsdTile& cells, const GridGeometry& geometry, Eigen::Vector2d corner_m);
  void build_level(int level);
  void build_phases();
  void choose_points(std::span<const Eigen::Vector2d> points);
  void turn_points(double yaw_rad);
  void bound_blocks(int yaw, std::vector<Node>& nodes);
  [[nodiscard]] int score(int level, Place corner, int least) const;
  void descend(Place corner, int level, double yaw_rad);
  void note(int score, Place place, double yaw_rad);
  [[nodiscard]] int least_score() const;
  [[nodiscard]] std::size_t at(Place place) const {
    return static_cast<std::size_t>(place.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(place.column);
  }

  GlobalSearchConfig config_;
  double spacing_m_ = 0.1;
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  std::int32_t columns_ = 0, rows_ = 0;  ///< multiples of kBlock
  /// Of each level, the best fit within the block whose lower left corner is here.
  std::array<std::vector<std::int8_t>, kLevels> fit_;
  std::vector<std::int8_t> phases_;        ///< the last level, by (row, column) modulo kBlock
  std::vector<std::uint8_t> free_;         ///< whether a head may stand here ...
  std::vector<std::uint8_t> free_blocks_;  ///< ... or anywhere in this block
  std::vector<Eigen::Vector2d> points_;
  std::vector<Place> offsets_;  ///< of the turned points from the head
  std::vector<std::int16_t> sums_;
  std::vector<GlobalCandidate> found_;
  int best_ = 0;
  int nodes_left_ = 0;
  bool complete_ = true;
};

}  // namespace lifeline::slam
