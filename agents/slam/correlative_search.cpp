#include "agents/slam/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "common/base/cpu_clones.hpp"
#include "common/grid/cell_lanes.hpp"

namespace lifeline::slam {
namespace {

/// Score of a point on a surface; the sum over 300 points still fits 16 bits.
constexpr int kFull = 100;

static_assert(TsdCell::kTsdOne % kFull == 0);

/// Summed at once, in vectors of GCC and Clang: so many places along x ...
constexpr int kLanes16 = 16;
/// ... in so many rows.
constexpr int kRows = 4;

/// The field at kLanes16 places in each of kRows rows, summed over all points.
LIFELINE_ALSO_FOR_AVX2
void sum_points(const std::int8_t* field, std::ptrdiff_t row,
                std::span<const std::ptrdiff_t> points, std::int16_t* sums,
                std::ptrdiff_t sums_row) {
  using Half = std::int8_t __attribute__((vector_size(8)));
  using Sums = std::int16_t __attribute__((vector_size(16)));
  std::array<std::array<Sums, 2>, kRows> total{};
  for (const std::ptrdiff_t point : points) {
    const std::int8_t* from = field + point;
    for (auto& sums_of_row : total) {
      std::array<Half, 2> fits;
      std::memcpy(fits.data(), from, sizeof fits);
      sums_of_row[0] += __builtin_convertvector(fits[0], Sums);
      sums_of_row[1] += __builtin_convertvector(fits[1], Sums);
      from += row;
    }
  }
  for (const auto& sums_of_row : total) {
    std::memcpy(sums, sums_of_row.data(), sizeof sums_of_row);
    sums += sums_row;
  }
}

/// How well a scan's point would fit into each of four cells; kUnknown where they are not known.
constexpr std::int32_t kUnknown = -128;
IntLanes fit(IntLanes cells, int free_penalty) {
  const IntLanes tsd = (cells << 16) >> 16;
  // The quotient of small whole numbers, cut off, is exact also by this way.
  const FloatLanes loss = __builtin_convertvector(magnitude(tsd), FloatLanes) /
                          static_cast<float>(TsdCell::kTsdOne / kFull);
  const IntLanes near = kFull - __builtin_convertvector(loss, IntLanes);
  const IntLanes known = choose(tsd > TsdCell::kTsdOne * 95 / 100, IntLanes{} - free_penalty, near);
  return choose(cells > kTsdBits, known, IntLanes{} + kUnknown);
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
  const double window_m = std::clamp(config_.window_sigmas * prediction.sigma_xy_m,
                                     2.0 * spacing_m_, config_.max_window_m);
  const double window_rad =
      std::min(config_.window_sigmas * prediction.sigma_yaw_rad, config_.max_window_rad);
  const int window = static_cast<int>(std::ceil(window_m / spacing_m_));
  build_field(map, prediction.T_map_head, window * spacing_m_);
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points_) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points_.size()));
  const double yaw_step_rad = std::clamp(1.2 * spacing_m_ / lever_m, 0.005, 0.05);
  const int yaws = static_cast<int>(std::ceil(window_rad / yaw_step_rad));
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

void CorrelativeSearch::build_field(const WorkingMap& map, const Pose2& centre, double window_m) {
  double reach_m = 0.0;
  for (const Eigen::Vector2d& p : points_) reach_m = std::max(reach_m, p.norm());
  reach_m += window_m + 2.0 * spacing_m_;
  const double tile_m = map.geometry().cell_size_m * kTileSide;
  const auto tile_at = [&](double at_m) {
    return static_cast<std::int32_t>(std::floor(at_m / tile_m));
  };
  const TileIndex low{tile_at(centre.x_m - reach_m), tile_at(centre.y_m - reach_m)};
  const TileIndex high{tile_at(centre.x_m + reach_m), tile_at(centre.y_m + reach_m)};
  columns_ = (high.x - low.x + 1) * kFieldSide;
  rows_ = (high.y - low.y + 1) * kFieldSide;
  field_origin_m_ = Eigen::Vector2d(low.x, low.y) * tile_m;
  field_.assign(
      static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_ + kRows) + kLanes16, 0);
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      const TsdTile* cells = map.find({x, y});
      if (cells == nullptr) continue;
      const TileField& tile = field_of({x, y}, *cells);
      auto to = field_.begin() + std::ptrdiff_t{(y - low.y) * kFieldSide} * columns_ +
                (x - low.x) * kFieldSide;
      for (auto from = tile.begin(); from != tile.end(); from += kFieldSide, to += columns_) {
        std::copy(from, from + kFieldSide, to);
      }
    }
  }
}

const CorrelativeSearch::TileField& CorrelativeSearch::field_of(TileIndex tile,
                                                                const TsdTile& cells) {
  const auto [slot, fresh] = fields_.try_emplace(tile);
  if (!fresh) return slot->second;
  const int penalty = static_cast<int>(std::lround(config_.free_penalty * kFull));
  for (int y = 0; y < kFieldSide; ++y) {
    const TsdCell* low = cells.data() + offset_in_tile({0, 2 * y});
    std::array<std::int32_t, kTileSide> best;  // of the two cells above each other
    for (std::size_t x = 0; x < best.size(); x += kLanes) {
      const IntLanes a = fit(load_cells(low + x), penalty);
      const IntLanes b = fit(load_cells(low + kTileSide + x), penalty);
      const IntLanes better = choose(a > b, a, b);
      std::memcpy(&best[x], &better, sizeof better);
    }
    for (std::size_t x = 0; x < kFieldSide; ++x) {
      const std::int32_t best_of_four = std::max(best[2 * x], best[2 * x + 1]);
      slot->second[static_cast<std::size_t>(y) * kFieldSide + x] =
          static_cast<std::int8_t>(best_of_four == kUnknown ? 0 : best_of_four);
    }
  }
  return slot->second;
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
  stride_ = (side + kLanes16 - 1) / kLanes16 * kLanes16;
  scores_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows));
  for (std::ptrdiff_t dy = 0; dy < rows; dy += kRows) {
    for (std::ptrdiff_t dx = 0; dx < stride_; dx += kLanes16) {
      sum_points(field_.data() + dy * columns_ + dx, columns_, corners_,
                 scores_.data() + dy * stride_ + dx, stride_);
    }
  }
}

double CorrelativeSearch::prior_penalty(const Prediction& prediction, double dx_m, double dy_m,
                                        double dyaw_rad) const {
  const double xy = (dx_m * dx_m + dy_m * dy_m) / (prediction.sigma_xy_m * prediction.sigma_xy_m);
  const double yaw = dyaw_rad * dyaw_rad / (prediction.sigma_yaw_rad * prediction.sigma_yaw_rad);
  return 0.5 * (xy + yaw);
}

void CorrelativeSearch::collect(const Prediction& prediction, double yaw_rad, int window) {
  const int side = 2 * window + 1;
  const double full = static_cast<double>(kFull) * static_cast<double>(points_.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const std::int16_t* here = scores_.data() + y * stride_ + x;
      if (*here <= 0 || (x > 0 && here[-1] > *here) || (x + 1 < side && here[1] > *here) ||
          (y > 0 && here[-stride_] > *here) || (y + 1 < side && here[stride_] > *here)) {
        continue;
      }
      const double dx_m = (x - window) * spacing_m_, dy_m = (y - window) * spacing_m_;
      const double dyaw_rad = normalise_angle(yaw_rad - prediction.T_map_head.yaw_rad);
      SearchCandidate candidate;
      candidate.T_map_head = {prediction.T_map_head.x_m + dx_m, prediction.T_map_head.y_m + dy_m,
                              normalise_angle(yaw_rad)};
      candidate.agreement = *here / full;
      candidate.score = config_.independent_points * candidate.agreement -
                        prior_penalty(prediction, dx_m, dy_m, dyaw_rad);
      found_.push_back(candidate);
    }
  }
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
