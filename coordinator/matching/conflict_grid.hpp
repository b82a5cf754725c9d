#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/rigid2f.hpp"

namespace lifeline::matching {

/// How much wall of either map lies in the other's clear space, for every translation at one
/// rotation, in squares of about half a metre. Counted for a sample of the walls.
class ConflictGrid {
 public:
  /// `turn` takes b's local coordinates to a's but for the translation.
  ConflictGrid(const MapFeatures& a, const MapFeatures& b, const Rigid2f& turn);

  /// Conflicting wall in metres, the mean of both sides, when b is turned and then shifted by `t`.
  [[nodiscard]] float conflict_m(const Eigen::Vector2f& t) const {
    return conflict_m(column_of(t.x()), row_of(t.y()));
  }
  /// The same in two steps, for whole rows of translations.
  [[nodiscard]] int column_of(float t_x) const { return nearest(t_x - first_.x()); }
  [[nodiscard]] int row_of(float t_y) const { return nearest(t_y - first_.y()); }
  [[nodiscard]] float conflict_m(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return 0.0F;
    return metres_per_count_ *
           static_cast<float>(counts_[static_cast<std::size_t>(row * columns_ + column)]);
  }

 private:
  [[nodiscard]] int nearest(float distance_m) const {
    return static_cast<int>(std::lround(distance_m * inverse_square_m_));
  }

  float inverse_square_m_ = 0.0F;
  int columns_ = 0;
  int rows_ = 0;
  Eigen::Vector2f first_ = Eigen::Vector2f::Zero();  ///< translation that square (0, 0) stands for
  float metres_per_count_ = 0.0F;
  std::vector<std::uint16_t> counts_;
};

}  // namespace lifeline::matching
