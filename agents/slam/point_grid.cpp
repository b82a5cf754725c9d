#include "agents/slam/point_grid.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/check.hpp"

namespace lifeline::slam {
namespace {

/// Points spread further take wider bins: slower to search, never more memory.
constexpr double kMaxBins = 250'000.0;
/// Coordinates beyond are no place in any building; differences of those below stay exact enough.
constexpr double kFarthestM = 1e9;

bool is_usable(const Eigen::Vector2d& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestM;
}

}  // namespace

PointGrid::PointGrid(std::span<const Eigen::Vector2d> points, double bin_m)
    : max_within_m_(bin_m), bin_m_(bin_m) {
  LIFELINE_CHECK(bin_m > 0.0);
  std::vector<std::size_t> usable;
  usable.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_usable(points[i])) usable.push_back(i);
  }
  if (!usable.empty()) lay_out(points, usable);
  first_of_bin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const std::size_t i : usable) ++first_of_bin_[bin_of(points[i])];
  std::size_t total = 0;
  for (std::size_t& first : first_of_bin_) total = first += total;
  points_.resize(usable.size());
  index_.resize(usable.size());
  for (auto i = usable.rbegin(); i != usable.rend(); ++i) {
    const std::size_t at = --first_of_bin_[bin_of(points[*i])];
    points_[at] = points[*i];
    index_[at] = *i;
  }
}

void PointGrid::lay_out(std::span<const Eigen::Vector2d> points,
                        std::span<const std::size_t> usable) {
  Eigen::Vector2d low = points[usable.front()], high = low;
  for (const std::size_t i : usable) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  corner_ = low;
  const auto bins = [&](double length_m) { return std::floor(length_m / bin_m_) + 1.0; };
  const Eigen::Vector2d size = high - low;
  while (bins(size.x()) * bins(size.y()) > kMaxBins) bin_m_ *= 2.0;
  columns_ = static_cast<std::int32_t>(bins(size.x()));
  rows_ = static_cast<std::int32_t>(bins(size.y()));
}

std::size_t PointGrid::bin_of(const Eigen::Vector2d& p) const {
  return static_cast<std::size_t>(bin_along(p.y() - corner_.y(), rows_)) *
             static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(bin_along(p.x() - corner_.x(), columns_));
}

std::int32_t PointGrid::bin_along(double from_corner_m, std::int32_t bins) const {
  return static_cast<std::int32_t>(
      std::clamp(std::floor(from_corner_m / bin_m_), -2.0, static_cast<double>(bins) + 1.0));
}

std::optional<PointGrid::Neighbour> PointGrid::nearest(const Eigen::Vector2d& p,
                                                       double within_m) const {
  LIFELINE_CHECK(within_m <= max_within_m_);
  if (!is_usable(p)) return std::nullopt;
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
