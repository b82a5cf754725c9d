#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace lifeline::slam {

/// Points sorted into square bins, for nearest neighbours within a bin's side. Built once, then
/// read.
class PointGrid {
 public:
  struct Neighbour {
    std::size_t index;  ///< into the points given at construction
    double distance_m;
  };

  /// Points that are not finite, or further than 1e9 m from the origin, are left out. Points spread
  /// far apart are put into wider bins, so that memory stays bounded (some 2 MB beside the points).
  PointGrid(std::span<const Eigen::Vector2d> points, double bin_m);

  /// How many points can be found.
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// The nearest point no further than `within_m`, which is at most the `bin_m` of
  /// construction. None for a place that is not finite.
  [[nodiscard]] std::optional<Neighbour> nearest(const Eigen::Vector2d& p, double within_m) const;

 private:
  void lay_out(std::span<const Eigen::Vector2d> points, std::span<const std::size_t> usable);
  [[nodiscard]] std::size_t bin_of(const Eigen::Vector2d& p) const;
  [[nodiscard]] std::int32_t bin_along(double from_corner_m, std::int32_t bins) const;

  double max_within_m_;
  double bin_m_;  ///< of the bins laid out: at least max_within_m_
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<Eigen::Vector2d> points_;    ///< sorted by bin
  std::vector<std::size_t> index_;         ///< of each, as given
  std::vector<std::size_t> first_of_bin_;  ///< with one more at the end
};

}  // namespace lifeline::slam
