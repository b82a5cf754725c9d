#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "agents/slam/slam_types.hpp"
#include "agents/slam/working_map.hpp"
#include "common/grid/scan_surface.hpp"

namespace lifeline::slam {

struct SearchConfig {
  int max_points = 150;        ///< of the scan that are compared
  double max_range_m = 20.0;   ///< points further away take no part
  double window_sigmas = 3.0;  ///< how far around the prediction is looked
  double max_window_m = 2.0;
  double max_window_rad = 0.6;
  int max_candidates = 6;
  double free_penalty = 0.4;       ///< of a point in known free space, against 1 on a surface
  double independent_points = 60;  ///< a scan's agreement counts like so many observations
};

/// A pose worth a closer look.
struct SearchCandidate {
  Pose2 T_map_head;
  double agreement = 0.0;  ///< mean over the points: 1 on surfaces, 0 in the unknown
  double score = 0.0;      ///< agreement and distance from the prediction, as a log-likelihood
};

/// Correlative search: compares the scan with the map at all poses of a lattice around a
/// prediction, on a field of two cells' spacing that says how well a scan's point would fit there.
/// The field is kept per tile until the tile changes. One owner.
class CorrelativeSearch {
 public:
  explicit CorrelativeSearch(SearchConfig config) : config_(config) {}

  /// These tiles have changed.
  void forget(std::span<const TileIndex> tiles);
  void forget_all() { fields_.clear(); }

  /// The best distinct poses, best first; empty where scan or map have nothing to compare.
  [[nodiscard]] std::vector<SearchCandidate> search(const WorkingMap& map,
                                                    std::span<const SurfacePiece> pieces,
                                                    const Prediction& prediction);

  [[nodiscard]] const SearchConfig& config() const { return config_; }

  /// Score of a point on a surface; the sum over 300 points still fits 16 bits.
  static constexpr int kFull = 100;
  static_assert(TsdCell::kTsdOne % kFull == 0);
  /// Summed at once: so many places along x in each of so many rows.
  static constexpr int kPlaces = 16, kRows = 4;

 private:
  static constexpr int kFieldSide = kTileSide / 2;
  static constexpr int kRim = 8;  ///< beside each row of scores
  using TileField = std::array<std::int8_t, static_cast<std::size_t>(kFieldSide* kFieldSide)>;

  void choose_points(std::span<const SurfacePiece> pieces);
  void build_field(const WorkingMap& map, const Pose2& centre, double window_m, double window_rad);
  /// Marks the tiles that any point may fall into.
  void mark_needed(const Pose2& centre, double window_m, double window_rad, double tile_m);
  [[nodiscard]] const TileField& field_of(TileIndex tile, const TsdTile& cells);
  void score_yaw(const Pose2& centre, double yaw_rad, int window);
  /// The first score of a row; row -1 is the rim's.
  [[nodiscard]] std::int16_t* row_of_scores(std::ptrdiff_t row) {
    return scores_.data() + (row + 1) * stride_ + kRim;
  }
  void add_candidate(const Prediction& prediction, double yaw_rad, double dx_m, double dy_m,
                     int score);
  void collect(const Prediction& prediction, double yaw_rad, int window);
  [[nodiscard]] std::vector<SearchCandidate> distinct(double yaw_step_rad);

  SearchConfig config_;
  std::unordered_map<TileIndex, TileField> fields_;
  std::vector<Eigen::Vector2d> points_;
  TileIndex first_tile_{};  ///< of the field
  int tile_columns_ = 0, tile_rows_ = 0;
  std::vector<bool> needed_;  ///< of its tiles: those that points may fall into
  /// The needed tiles' fields side by side, with a margin; between them, anything.
  std::vector<std::int16_t> field_;
  Eigen::Vector2d field_origin_m_ = Eigen::Vector2d::Zero();
  double spacing_m_ = 0.1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::ptrdiff_t> corners_;  ///< in field_, of each turned point's window
  std::vector<std::int16_t> scores_;     ///< of one yaw, with a rim that is worse than any
  std::ptrdiff_t stride_ = 0;            ///< from row to row
  std::vector<SearchCandidate> found_;
};

}  // namespace lifeline::slam
