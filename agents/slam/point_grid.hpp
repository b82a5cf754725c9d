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

  /// All coordinates must be finite. Points spread over more than 4000 bins a side share the outer
  /// bins and are not found across them.
  PointGrid(std::span<const Eigen::Vector2d> points, double bin_m);

  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// The nearest point no further than `within_m`, which is at most the bin's side.
  [[nodiscard]] std::optional<Neighbour> nearest(const Eigen::Vector2d& p, double within_m) const;

 private:
  [[nodiscard]] std::int32_t bin_along(double from_corner_m, std::int32_t bins) const;

  double bin_m_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<Eigen::Vector2d> points_;    ///< sorted by bin
  std::vector<std::size_t> index_;         ///< of each, as given
  std::vector<std::size_t> first_of_bin_;  ///< with one more at the end
};

}  // namespace lifeline::slam
