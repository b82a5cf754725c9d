#pragma once

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
    const auto x = static_cast<int>(std::lround((t.x() - first_.x()) * inverse_square_m_));
    const auto y = static_cast<int>(std::lround((t.y() - first_.y()) * inverse_square_m_));
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return 0.0F;
    return metres_per_count_ *
           static_cast<float>(counts_[static_cast<std::size_t>(y * columns_ + x)]);
  }

 private:
  float inverse_square_m_ = 0.0F;
  int columns_ = 0;
  int rows_ = 0;
  Eigen::Vector2f first_ = Eigen::Vector2f::Zero();  ///< translation that square (0, 0) stands for
  float metres_per_count_ = 0.0F;
  std::vector<std::uint16_t> counts_;
};

}  // namespace lifeline::matching
