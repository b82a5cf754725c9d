#include "agents/slam/point_grid.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {
constexpr double kMaxBins = 4000.0;
}

PointGrid::PointGrid(std::span<const Eigen::Vector2d> points, double bin_m) : bin_m_(bin_m) {
  LIFELINE_CHECK(bin_m > 0.0);
  if (points.empty()) {
    first_of_bin_.assign(2, 0);
    return;
  }
  Eigen::Vector2d low = points.front(), high = points.front();
  for (const Eigen::Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  corner_ = low;
  columns_ = static_cast<std::int32_t>(std::min((high.x() - low.x()) / bin_m, kMaxBins)) + 1;
  rows_ = static_cast<std::int32_t>(std::min((high.y() - low.y()) / bin_m, kMaxBins)) + 1;
  const auto bin_of = [&](const Eigen::Vector2d& p) {
    return static_cast<std::size_t>(bin_along(p.y() - corner_.y(), rows_)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(bin_along(p.x() - corner_.x(), columns_));
  };
  first_of_bin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Eigen::Vector2d& p : points) ++first_of_bin_[bin_of(p)];
  std::size_t total = 0;
  for (std::size_t& first : first_of_bin_) total = first += total;
  points_.resize(points.size());
  index_.resize(points.size());
  for (std::size_t i = points.size(); i-- > 0;) {
    const std::size_t at = --first_of_bin_[bin_of(points[i])];
    points_[at] = points[i];
    index_[at] = i;
  }
}

std::int32_t PointGrid::bin_along(double from_corner_m, std::int32_t bins) const {
  return static_cast<std::int32_t>(
      std::clamp(std::floor(from_corner_m / bin_m_), -2.0, static_cast<double>(bins) + 1.0));
}

std::optional<PointGrid::Neighbour> PointGrid::nearest(const Eigen::Vector2d& p,
                                                       double within_m) const {
  LIFELINE_CHECK(within_m <= bin_m_);
  const std::int32_t column = bin_along(p.x() - corner_.x(), columns_);
  const std::int32_t row = bin_along(p.y() - corner_.y(), rows_);
  double best_m2 = within_m * within_m;
  std::optional<std::size_t> best;
  for (std::int32_t y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y) {
    for (std::int32_t x = std::max(column - 1, 0); x <= std::min(column + 1, columns_ - 1); ++x) {
      const auto bin = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(x);
      for (std::size_t i = first_of_bin_[bin]; i < first_of_bin_[bin + 1]; ++i) {
        const double distance_m2 = (points_[i] - p).squaredNorm();
        if (distance_m2 > best_m2) continue;
        best_m2 = distance_m2;
        best = i;
      }
    }
  }
  if (!best) return std::nullopt;
  return Neighbour{index_[*best], std::sqrt(best_m2)};
}

}  // namespace lifeline::slam
