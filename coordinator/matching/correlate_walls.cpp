#include "coordinator/matching/correlate_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Geometry>

#include "coordinator/matching/conflict_grid.hpp"
#include "coordinator/matching/rigid2f.hpp"

namespace lifeline::matching {
namespace {

constexpr int kFacings = 24;
constexpr float kSquare_m = 0.25F;
/// Larger maps are correlated in coarser squares.
constexpr float kMaxSquares = 4.0e6F;

/// Wall points of one map that face about the same way: their squares, and their weights.
struct Facing {
  std::vector<std::int32_t> columns, rows;
  std::vector<float> weights;
};

using Facings = std::array<Facing, kFacings>;

/// A value for every translation from b to a, in squares.
struct TranslationGrid {
  float square_m;
  int columns, rows;
  Eigen::Vector2i offset;  ///< the square that stands for corner on corner
  Eigen::Vector2f corner;  ///< and the translation of that
  std::vector<float> values;

  [[nodiscard]] Eigen::Vector2f translation(std::size_t index) const {
    const Eigen::Vector2i at(static_cast<int>(index) % columns, static_cast<int>(index) / columns);
    return (at - offset).cast<float>() * square_m + corner;
  }
};

Eigen::AlignedBox2f bounds(const std::vector<WallPoint>& walls, const Rigid2f& turn) {
  Eigen::AlignedBox2f box;
  for (const WallPoint& wall : walls) box.extend(turn * wall.p);
  return box;
}

Facings sort_by_facing(const std::vector<WallPoint>& walls, const Rigid2f& turn,
                       const Eigen::Vector2f& corner, float square_m) {
  Facings facings;
  for (const WallPoint& wall : walls) {
    const Eigen::Vector2f normal = turn.turn(wall.normal);
    const float angle = std::atan2(normal.y(), normal.x()) / (2 * std::numbers::pi_v<float>);
    const auto slot = static_cast<std::size_t>(
        (static_cast<int>(std::lround(angle * kFacings)) + kFacings) % kFacings);
    const Eigen::Vector2f p = (turn * wall.p - corner) / square_m;
    facings[slot].columns.push_back(static_cast<std::int32_t>(p.x()));
    facings[slot].rows.push_back(static_cast<std::int32_t>(p.y()));
    facings[slot].weights.push_back(wall.length_m);
  }
  return facings;
}

/// All pairs of `a` and `b` vote for the translation that brings them together.
void vote(const Facing& a, const Facing& b, float factor, TranslationGrid& grid) {
  std::vector<std::int32_t> steps(b.columns.size());
  for (std::size_t j = 0; j < steps.size(); ++j) {
    steps[j] = b.rows[j] * grid.columns + b.columns[j];
  }
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    float* const at = grid.values.data() + (a.rows[i] + grid.offset.y()) * grid.columns +
                      a.columns[i] + grid.offset.x();
    const float weight = factor * a.weights[i];
    for (std::size_t j = 0; j < steps.size(); ++j) at[-steps[j]] += weight * b.weights[j];
  }
}

/// Sums 3 x 3 squares with weights 1 2 1: two points in squares side by side may be together. One
/// metre of wall on wall then counts about two; halved, the values are metres.
std::vector<float> blur(const TranslationGrid& grid) {
  const std::vector<float>& values = grid.values;
  const std::size_t n = values.size(), width = static_cast<std::size_t>(grid.columns);
  std::vector<float> across(n, 0.0F), blurred(n, 0.0F);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    across[i] = values[i - 1] + 2 * values[i] + values[i + 1];
  }
  for (std::size_t i = width; i + width < n; ++i) {
    blurred[i] = 0.5F * (across[i - width] + 2 * across[i] + across[i + width]);
  }
  return blurred;
}

struct Maximum {
  float value;
  std::size_t index;
};

std::vector<Maximum> highest_maxima(const std::vector<float>& values, int columns,
                                    std::size_t count) {
  const auto width = static_cast<std::size_t>(columns);
  const auto lower = [](const Maximum& x, const Maximum& y) {
    return x.value > y.value || (x.value == y.value && x.index < y.index);
  };
  std::vector<Maximum> heap;  // the lowest of those kept on top
  for (std::size_t i = width + 1; i + width + 1 < values.size(); ++i) {
    const float v = values[i];
    if (v <= 0 || (heap.size() == count && v <= heap.front().value)) continue;
    if (v < values[i - 1] || v <= values[i + 1] || v < values[i - width] ||
        v <= values[i + width] || v < values[i - width - 1] || v < values[i - width + 1] ||
        v <= values[i + width - 1] || v <= values[i + width + 1]) {
      continue;
    }
    if (heap.size() == count) {
      std::pop_heap(heap.begin(), heap.end(), lower);
      heap.pop_back();
    }
    heap.push_back({v, i});
    std::push_heap(heap.begin(), heap.end(), lower);
  }
  std::sort_heap(heap.begin(), heap.end(), lower);
  return heap;
}

/// The empty grid of all translations at which the two boxes touch.
TranslationGrid make_grid(const Eigen::AlignedBox2f& a, const Eigen::AlignedBox2f& b) {
  const Eigen::Vector2f extent = a.sizes() + b.sizes();
  const float square_m = std::max(kSquare_m, std::sqrt(extent.x() * extent.y() / kMaxSquares));
  // Two squares of margin for the blur.
  const Eigen::Vector2i offset = (b.sizes() / square_m).cast<int>() + Eigen::Vector2i(2, 2);
  const Eigen::Vector2i size = (a.sizes() / square_m).cast<int>() + offset + Eigen::Vector2i(3, 3);
  return {square_m,
          size.x(),
          size.y(),
          offset,
          a.min() - b.min(),
          std::vector<float>(
              static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()), 0.0F)};
}

/// Fills the grid with about the agreeing wall in metres.
void vote_all(const Facings& a, const Facings& b, TranslationGrid& grid) {
  for (int i = 0; i < kFacings; ++i) {
    for (const int j : {-1, 0, 1}) {
      const auto other = static_cast<std::size_t>((i + j + kFacings) % kFacings);
      vote(a[static_cast<std::size_t>(i)], b[other], j == 0 ? 1.0F : 0.7F, grid);
    }
  }
  grid.values = blur(grid);
}

void subtract(const ConflictGrid& conflicts, float weight, TranslationGrid& grid) {
  const auto width = static_cast<std::size_t>(grid.columns);
  std::vector<int> columns(width);
  for (std::size_t i = 0; i < width; ++i) columns[i] = conflicts.column_of(grid.translation(i).x());
  for (std::size_t first = 0; first < grid.values.size(); first += width) {
    const int row = conflicts.row_of(grid.translation(first).y());
    for (std::size_t i = 0; i < width; ++i) {
      float& value = grid.values[first + i];
      if (value > 0) value -= weight * conflicts.conflict_m(columns[i], row);
    }
  }
}

}  // namespace

std::vector<CorrelationPeak> correlate_walls(const MapFeatures& a, const MapFeatures& b,
                                             double yaw_rad, float conflict_weight,
                                             std::size_t count) {
  if (a.skeleton.empty() || b.skeleton.empty() || count == 0) return {};
  const Rigid2f still, turn(Pose2{0.0, 0.0, yaw_rad});
  const Eigen::AlignedBox2f box_a = bounds(a.skeleton, still), box_b = bounds(b.skeleton, turn);
  TranslationGrid grid = make_grid(box_a, box_b);
  vote_all(sort_by_facing(a.skeleton, still, box_a.min(), grid.square_m),
           sort_by_facing(b.skeleton, turn, box_b.min(), grid.square_m), grid);
  subtract(ConflictGrid(a, b, turn), conflict_weight, grid);
  std::vector<CorrelationPeak> peaks;
  for (const Maximum& maximum : highest_maxima(grid.values, grid.columns, count)) {
    const Eigen::Vector2f t = grid.translation(maximum.index);
    peaks.push_back({Pose2{t.x(), t.y(), normalise_angle(yaw_rad)}, maximum.value});
  }
  return peaks;
}

}  // namespace lifeline::matching
