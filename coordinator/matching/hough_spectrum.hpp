#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "coordinator/matching/wall_points.hpp"

namespace lifeline::matching {

/// A Hough spectrum: HS(theta) = sum over rho of H(theta, rho)^2, H being the Hough transform. It
/// turns with the map and does not change when the map is shifted. Evenly spaced over its period;
/// the largest value is 1, or all are 0 where there is no wall.
using Spectrum = std::vector<double>;

inline constexpr std::size_t kSpectrumBinsPerDegree = 1;
/// Bins between two peaks of a correlation of spectra that count as different rotations.
inline constexpr std::size_t kRotationSeparation = 4 * kSpectrumBinsPerDegree;

/// The paper's spectrum over half a circle, of the occupied cells.
[[nodiscard]] Spectrum hough_spectrum(const OccupancyGrid& preprocessed);

/// The oriented spectrum over the full circle: each wall votes only for directions within 12
/// degrees of its normal, so that a wall and the one behind it are told apart.
[[nodiscard]] Spectrum oriented_spectrum(const std::vector<WallPoint>& walls);

/// correlation[k] = sum over i of a[i] * b[i - k]: large where b turned by k bins looks like a.
/// Both of the same size.
[[nodiscard]] Spectrum circular_correlation(const Spectrum& a, const Spectrum& b);

struct SpectrumPeak {
  double bin = 0.0;  ///< refined below a bin, in [0, size)
  double value = 0.0;
};

/// The highest local maxima of a circular sequence, from high to low, at least `separation` bins
/// apart, at most `count`.
[[nodiscard]] std::vector<SpectrumPeak> circular_maxima(const Spectrum& values,
                                                        std::size_t separation, std::size_t count);

}  // namespace lifeline::matching
