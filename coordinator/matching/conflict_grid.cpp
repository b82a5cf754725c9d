#include "coordinator/matching/conflict_grid.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lifeline::matching {
namespace {

/// Every so manieth wall point is counted, so that the cost stays below a fixed one per square.
/// Also keeps the counts within 16 bits.
constexpr std::size_t kMaxSamples = 400;

std::size_t stride(const std::vector<WallPoint>& walls) {
  return 1 + walls.size() / kMaxSamples;
}

/// A map's clear space, turned; its corner lies at `corner`.
struct ClearRaster {
  int columns, rows;
  Eigen::Vector2f corner;
  std::vector<std::uint16_t> clear;  ///< 1 or 0
};

ClearRaster turn_clear(const WallField& field, const Rigid2f& turn) {
  const float square = field.coarse_square_m();
  Eigen::AlignedBox2f hull;
  for (const float x : {0.0F, square * static_cast<float>(field.coarse_columns())}) {
    for (const float y : {0.0F, square * static_cast<float>(field.coarse_rows())}) {
      hull.extend(turn.turn({x, y}));
    }
  }
  const Eigen::Vector2i size = (hull.sizes() / square).cast<int>() + Eigen::Vector2i(1, 1);
  ClearRaster raster{size.x(), size.y(), hull.min(), {}};
  raster.clear.reserve(static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()));
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      const Eigen::Vector2f middle(static_cast<float>(column) + 0.5F,
                                   static_cast<float>(row) + 0.5F);
      raster.clear.push_back(field.coarse_clear(turn.turn_back(hull.min() + square * middle)) ? 1
                                                                                              : 0);
    }
  }
  return raster;
}

void add(std::uint16_t* to, const std::uint16_t* from, int count) {
  for (int i = 0; i < count; ++i) to[i] = static_cast<std::uint16_t>(to[i] + from[i]);
}

}  // namespace

ConflictGrid::ConflictGrid(const MapFeatures& a, const MapFeatures& b, const Rigid2f& turn) {
  const float square = std::max(a.field.coarse_square_m(), b.field.coarse_square_m());
  inverse_square_m_ = 1.0F / square;
  const ClearRaster clear_a = turn_clear(a.field, Rigid2f());
  ClearRaster clear_b = turn_clear(b.field, turn);
  columns_ = clear_a.columns + clear_b.columns;
  rows_ = clear_a.rows + clear_b.rows;
  const int last_x = clear_b.columns - 1, last_y = clear_b.rows - 1;
  // Square (i, j) stands for b's square (k, l) on a's square (i + k - last_x, j + l - last_y).
  first_ = -clear_b.corner - square * Eigen::Vector2i(last_x, last_y).cast<float>();
  counts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);

  for (std::size_t i = 0; i < b.skeleton.size(); i += stride(b.skeleton)) {
    const Eigen::Vector2i at = ((turn.turn(b.skeleton[i].p) - clear_b.corner) / square).cast<int>();
    for (int row = 0; row < clear_a.rows; ++row) {
      add(&counts_[static_cast<std::size_t>((row - at.y() + last_y) * columns_ + last_x - at.x())],
          &clear_a.clear[static_cast<std::size_t>(row * clear_a.columns)], clear_a.columns);
    }
  }
  // The other way round b's raster runs backwards.
  std::reverse(clear_b.clear.begin(), clear_b.clear.end());
  for (std::size_t i = 0; i < a.skeleton.size(); i += stride(a.skeleton)) {
    const Eigen::Vector2i at = (a.skeleton[i].p / square).cast<int>();
    for (int row = 0; row < clear_b.rows; ++row) {
      add(&counts_[static_cast<std::size_t>((at.y() + row) * columns_ + at.x())],
          &clear_b.clear[static_cast<std::size_t>(row * clear_b.columns)], clear_b.columns);
    }
  }
  metres_per_count_ =
      0.25F * kSkeletonSpacing_m * static_cast<float>(stride(a.skeleton) + stride(b.skeleton));
}

}  // namespace lifeline::matching
