// How FitField bounds blocks of places: the sums over all points, of many blocks at a time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "agents/slam/fit_field.hpp"
#include "common/base/check.hpp"
#include "common/base/cpu_clones.hpp"

namespace lifeline::slam {
namespace {

// Estimated, in steps of SearchWork, for each point.
constexpr SearchWork kRowWork = 2;     ///< in a row of blocks
constexpr SearchWork kBlocksWork = 2;  ///< in FitField::kAtOnce of its blocks

/// Sums the fits at `at` of all points, for FitField::kAtOnce blocks. Whether any sum is `least` or
/// more.
LIFELINE_ALSO_FOR_AVX2
bool sum_blocks(std::span<const std::int8_t* const> points, std::ptrdiff_t at, std::int16_t least,
                std::int16_t* sums) {
  using Fits = std::int8_t __attribute__((vector_size(16)));
  using Half = std::int8_t __attribute__((vector_size(8)));
  using Totals = std::int16_t __attribute__((vector_size(16)));
  constexpr std::size_t kVectors = FitField::kAtOnce / sizeof(Fits);
  // So many fits of -4 to 10 always fit 8 bits.
  constexpr std::size_t kFitting = std::numeric_limits<std::int8_t>::max() / FitField::kFull;
  std::array<std::array<Totals, 2>, kVectors> total{};
  for (std::size_t i = 0; i < points.size();) {
    std::array<Fits, kVectors> some{};
    for (const std::size_t end = std::min(i + kFitting, points.size()); i < end; ++i) {
      std::array<Fits, kVectors> fits;
      std::memcpy(fits.data(), points[i] + at, sizeof fits);
      for (std::size_t v = 0; v < kVectors; ++v) some[v] += fits[v];
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
      std::array<Half, 2> halves;
      std::memcpy(halves.data(), &some[v], sizeof halves);
      total[v][0] += __builtin_convertvector(halves[0], Totals);
      total[v][1] += __builtin_convertvector(halves[1], Totals);
    }
  }
  Totals enough{};
  for (const auto& halves : total) enough |= (halves[0] >= least) | (halves[1] >= least);
  std::memcpy(sums, total.data(), sizeof total);
  std::array<std::int64_t, 2> any;
  std::memcpy(any.data(), &enough, sizeof any);
  return (any[0] | any[1]) != 0;
}

}  // namespace

FitField::Blocks FitField::blocks_around(const Eigen::Vector2d& p_map, double radius_m) const {
  const double block_m = kBlock * spacing_m_;
  const Blocks all = blocks();
  const auto within = [&](double at_m, std::int32_t most) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(at_m / block_m), 0.0, static_cast<double>(most)));
  };
  const Eigen::Vector2d low = p_map.array() - radius_m - origin_m_.array();
  const Eigen::Vector2d high = p_map.array() + radius_m - origin_m_.array() + block_m;
  return {within(low.x(), all.right), within(low.y(), all.high), within(high.x(), all.right),
          within(high.y(), all.high)};
}

void FitField::bound_blocks(std::span<const Place> offsets, const Blocks& among, int least,
                            std::vector<BlockBound>& bounds, SearchWork& work) {
  const std::size_t blocks = free_blocks_.size();
  points_.clear();
  for (const Place& offset : offsets) {
    LIFELINE_CHECK(std::abs(offset.column) <= kReach && std::abs(offset.row) <= kReach);
    const int phase = (offset.row & (kBlock - 1)) * kBlock + (offset.column & (kBlock - 1));
    const std::int32_t right = offset.column >> (kLevels - 1), up = offset.row >> (kLevels - 1);
    const std::int8_t* fits = phases_.data() + kRim + static_cast<std::size_t>(phase) * blocks;
    points_.push_back({fits + right, up});
  }
  for (std::int32_t row = among.low; row < among.high; ++row) {
    const Run& free = free_runs_[static_cast<std::size_t>(row)];
    const Run run{std::max(free.first, among.left), std::min(free.end, among.right)};
    if (run.first >= run.end) continue;
    bound_row(row, run, least, bounds);
    const auto points = static_cast<SearchWork>(row_fits_.size());
    work -= points * (kRowWork + kBlocksWork * ((run.end - run.first) / kAtOnce + 1));
  }
}

void FitField::bound_row(std::int32_t row, Run run, int least, std::vector<BlockBound>& bounds) {
  row_fits_.clear();
  for (const PointFits& point : points_) {
    const std::int32_t there = row + point.up;
    if (there < 0 || there >= rows_ / kBlock) continue;
    row_fits_.push_back(point.fits + std::ptrdiff_t{there} * block_stride_);
  }
  std::array<std::int16_t, kAtOnce> sums;
  for (std::int32_t first = run.first; first < run.end; first += kAtOnce) {
    if (!sum_blocks(row_fits_, first, static_cast<std::int16_t>(least), sums.data())) continue;
    const std::int32_t count = std::min(kAtOnce, run.end - first);
    for (std::int32_t i = 0; i < count; ++i) {
      const std::int32_t block = row * block_stride_ + first + i;
      const std::int16_t bound = sums[static_cast<std::size_t>(i)];
      if (bound < least || free_blocks_[static_cast<std::size_t>(block)] == 0) continue;
      bounds.push_back({block, bound});
    }
  }
}

}  // namespace lifeline::slam
