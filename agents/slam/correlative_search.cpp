#include "agents/slam/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "common/base/cpu_clones.hpp"
#include "common/grid/cell_lanes.hpp"

namespace lifeline::slam {
namespace {

/// Worse than any sum.
constexpr std::int16_t kWorst = std::numeric_limits<std::int16_t>::min();

/// Vectors of GCC and Clang.
using Sums = std::int16_t __attribute__((vector_size(16)));
constexpr int kSums = sizeof(Sums) / sizeof(std::int16_t);
static_assert(CorrelativeSearch::kPlaces == 2 * kSums);

Sums load_sums(const std::int16_t* from) {
  Sums sums;
  std::memcpy(&sums, from, sizeof sums);
  return sums;
}

/// The field at CorrelativeSearch::kPlaces x kRows places, summed over all points.
LIFELINE_ALSO_FOR_AVX2
void sum_points(const std::int16_t* field, std::ptrdiff_t row,
                std::span<const std::ptrdiff_t> points, std::int16_t* sums,
                std::ptrdiff_t sums_row) {
  std::array<std::array<Sums, 2>, CorrelativeSearch::kRows> total{};
  for (const std::ptrdiff_t point : points) {
    const std::int16_t* from = field + point;
    for (auto& sums_of_row : total) {
      std::array<Sums, 2> fits;
      std::memcpy(fits.data(), from, sizeof fits);
      sums_of_row[0] += fits[0];
      sums_of_row[1] += fits[1];
      from += row;
    }
  }
  for (const auto& sums_of_row : total) {
    std::memcpy(sums, sums_of_row.data(), sizeof sums_of_row);
    sums += sums_row;
  }
}

/// Which of kSums scores are above 0 and no neighbour along x or y is better: -1.
Sums are_peaks(const std::int16_t* scores, std::ptrdiff_t row) {
  const Sums here = load_sums(scores);
  return (here > 0) & (load_sums(scores - 1) <= here) & (load_sums(scores + 1) <= here) &
         (load_sums(scores - row) <= here) & (load_sums(scores + row) <= here);
}

}  // namespace

void CorrelativeSearch::forget(std::span<const TileIndex> tiles) {
  for (const TileIndex tile : tiles) fields_.erase(tile);
}

std::vector<SearchCandidate> CorrelativeSearch::search(const WorkingMap& map,
                                                       std::span<const SurfacePiece> pieces,
                                                       const Prediction& prediction) {
  choose_points(pieces);
  found_.clear();
  if (points_.empty()) return {};
  spacing_m_ = 2.0 * map.geometry().cell_size_m;
  const double window_m = std::clamp(config_.window_sigmas * prediction.largest_sigma_m(),
                                     2.0 * spacing_m_, config_.max_window_m);
  const double window_rad =
      std::min(config_.window_sigmas * prediction.sigma_yaw_rad, config_.max_window_rad);
  const int window = static_cast<int>(std::ceil(window_m / spacing_m_));
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points_) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points_.size()));
  const double yaw_step_rad = std::clamp(1.2 * spacing_m_ / lever_m, 0.005, 0.05);
  const int yaws = static_cast<int>(std::ceil(window_rad / yaw_step_rad));
  build_field(map, prediction.T_map_head, window * spacing_m_, yaws * yaw_step_rad);
  for (int k = -yaws; k <= yaws; ++k) {
    const double yaw_rad = prediction.T_map_head.yaw_rad + k * yaw_step_rad;
    score_yaw(prediction.T_map_head, yaw_rad, window);
    collect(prediction, yaw_rad, window);
  }
  return distinct(yaw_step_rad);
}

void CorrelativeSearch::choose_points(std::span<const SurfacePiece> pieces) {
  points_.clear();
  const double near2_m2 = config_.max_range_m * config_.max_range_m;
  for (const SurfacePiece& piece : pieces) {
    const Eigen::Vector2d p = piece.point.cast<double>();
    if (p.squaredNorm() < near2_m2) points_.push_back(p);
  }
  // Evenly thinned along the sweep.
  const auto most = static_cast<std::size_t>(config_.max_points);
  if (points_.size() <= most) return;
  const std::size_t all = points_.size();
  for (std::size_t i = 0; i < most; ++i) points_[i] = points_[i * all / most];
  points_.resize(most);
}

void CorrelativeSearch::score_yaw(const Pose2& centre, double yaw_rad, int window) {
  const int side = 2 * window + 1;
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  corners_.clear();
  for (const Eigen::Vector2d& p : points_) {
    const double x_m = centre.x_m + c * p.x() - s * p.y() - field_origin_m_.x();
    const double y_m = centre.y_m + s * p.x() + c * p.y() - field_origin_m_.y();
    const int column = static_cast<int>(std::floor(x_m / spacing_m_)) - window;
    const int row = static_cast<int>(std::floor(y_m / spacing_m_)) - window;
    if (column < 0 || row < 0 || column + side > columns_ || row + side > rows_) continue;
    corners_.push_back(std::ptrdiff_t{row} * columns_ + column);
  }
  // Summed in whole blocks; what the last ones hold beyond the window is never read.
  const int rows = (side + kRows - 1) / kRows * kRows;
  const int columns = (side + kPlaces - 1) / kPlaces * kPlaces;
  stride_ = columns + 2 * kRim;
  scores_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows + 2));
  for (int dy = 0; dy < rows; dy += kRows) {
    for (int dx = 0; dx < columns; dx += kPlaces) {
      sum_points(field_.data() + std::ptrdiff_t{dy} * columns_ + dx, columns_, corners_,
                 row_of_scores(dy) + dx, stride_);
    }
  }
  for (int row = 0; row < side; ++row) row_of_scores(row)[-1] = row_of_scores(row)[side] = kWorst;
  std::fill_n(row_of_scores(-1), columns, kWorst);
  std::fill_n(row_of_scores(side), columns, kWorst);
}

void CorrelativeSearch::collect(const Prediction& prediction, double yaw_rad, int window) {
  const int side = 2 * window + 1;
  for (int y = 0; y < side; ++y) {
    const std::int16_t* scores = row_of_scores(y);
    for (int x = 0; x < side; x += kSums) {
      const Sums peaks = are_peaks(scores + x, stride_);
      if (!any(std::bit_cast<IntLanes>(peaks))) continue;
      for (int i = 0; i < std::min(kSums, side - x); ++i) {
        if (peaks[i] == 0) continue;
        add_candidate(prediction, yaw_rad, (x + i - window) * spacing_m_, (y - window) * spacing_m_,
                      scores[x + i]);
      }
    }
  }
}

void CorrelativeSearch::add_candidate(const Prediction& prediction, double yaw_rad, double dx_m,
                                      double dy_m, int score) {
  const double full = static_cast<double>(kFull) * static_cast<double>(points_.size());
  SearchCandidate candidate;
  candidate.T_map_head = {prediction.T_map_head.x_m + dx_m, prediction.T_map_head.y_m + dy_m,
                          normalise_angle(yaw_rad)};
  candidate.agreement = score / full;
  candidate.score = config_.independent_points * candidate.agreement -
                    deviation(candidate.T_map_head, prediction);
  found_.push_back(candidate);
}

std::vector<SearchCandidate> CorrelativeSearch::distinct(double yaw_step_rad) {
  std::stable_sort(
      found_.begin(), found_.end(),
      [](const SearchCandidate& a, const SearchCandidate& b) { return a.score > b.score; });
  std::vector<SearchCandidate> kept;
  for (const SearchCandidate& candidate : found_) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const SearchCandidate& other) {
      const Pose2 &a = candidate.T_map_head, &b = other.T_map_head;
      return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < 2.5 * spacing_m_ &&
             std::abs(normalise_angle(a.yaw_rad - b.yaw_rad)) < 2.5 * yaw_step_rad;
    });
    if (is_new) kept.push_back(candidate);
    if (kept.size() == static_cast<std::size_t>(config_.max_candidates)) break;
  }
  return kept;
}

}  // namespace lifeline::slam
