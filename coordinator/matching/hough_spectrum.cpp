#include "coordinator/matching/hough_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "common/base/check.hpp"

namespace lifeline::matching {
namespace {

constexpr float kRhoStep_m = 0.1F;
constexpr int kHalfTurn = 180 * static_cast<int>(kSpectrumBinsPerDegree);
constexpr int kFullTurn = 2 * kHalfTurn;
constexpr int kOrientedWindow = 12 * static_cast<int>(kSpectrumBinsPerDegree);
/// Largest transform that is built; rho is taken in coarser steps for larger maps.
constexpr int kMaxRhoBins = 1 << 13;

struct Direction {
  float cos, sin;
};

std::vector<Direction> directions(int bins) {
  std::vector<Direction> table;
  for (int i = 0; i < bins; ++i) {
    const float angle =
        static_cast<float>(i) * std::numbers::pi_v<float> / static_cast<float>(kHalfTurn);
    table.push_back({std::cos(angle), std::sin(angle)});
  }
  return table;
}

/// H(theta, rho), rho measured from the middle of the map.
class HoughTransform {
 public:
  HoughTransform(int bins, const Eigen::Vector2f& centre, float radius_m)
      : centre_(centre),
        directions_(directions(bins)),
        step_m_(std::max(kRhoStep_m, 2 * radius_m / kMaxRhoBins)),
        rho_bins_(static_cast<std::size_t>(2 * radius_m / step_m_) + 3) {
    votes_.assign(static_cast<std::size_t>(bins) * rho_bins_, 0.0F);
  }

  void vote(int bin, const Eigen::Vector2f& p, float weight) {
    const Direction& d = directions_[static_cast<std::size_t>(bin)];
    const Eigen::Vector2f from_centre = p - centre_;
    const float rho = from_centre.x() * d.cos + from_centre.y() * d.sin;
    const auto slot =
        static_cast<std::size_t>(rho / step_m_ + 0.5F * static_cast<float>(rho_bins_));
    votes_[static_cast<std::size_t>(bin) * rho_bins_ + slot] += weight;
  }

  [[nodiscard]] Spectrum spectrum() const {
    Spectrum spectrum(directions_.size(), 0.0);
    for (std::size_t bin = 0; bin < spectrum.size(); ++bin) {
      for (std::size_t slot = 0; slot < rho_bins_; ++slot) {
        const double votes = votes_[bin * rho_bins_ + slot];
        spectrum[bin] += votes * votes;
      }
    }
    const double largest = *std::max_element(spectrum.begin(), spectrum.end());
    if (largest > 0) {
      for (double& value : spectrum) value /= largest;
    }
    return spectrum;
  }

 private:
  Eigen::Vector2f centre_;
  std::vector<Direction> directions_;
  float step_m_;
  std::size_t rho_bins_;
  std::vector<float> votes_;
};

}  // namespace

Spectrum hough_spectrum(const OccupancyGrid& preprocessed) {
  const auto cell_m = static_cast<float>(preprocessed.cell_size_m);
  const Eigen::Vector2f corner = cell_m * Eigen::Vector2f(static_cast<float>(preprocessed.columns),
                                                          static_cast<float>(preprocessed.rows));
  HoughTransform transform(kHalfTurn, corner / 2, corner.norm() / 2);
  for (int row = 0; row < preprocessed.rows; ++row) {
    for (int column = 0; column < preprocessed.columns; ++column) {
      if (preprocessed.cells[preprocessed.index(column, row)] != Occupancy::occupied) continue;
      const Eigen::Vector2f p((static_cast<float>(column) + 0.5F) * cell_m,
                              (static_cast<float>(row) + 0.5F) * cell_m);
      for (int bin = 0; bin < kHalfTurn; ++bin) transform.vote(bin, p, 1.0F);
    }
  }
  return transform.spectrum();
}

Spectrum oriented_spectrum(const std::vector<WallPoint>& walls) {
  Eigen::AlignedBox2f box(Eigen::Vector2f::Zero());
  for (const WallPoint& wall : walls) box.extend(wall.p);
  HoughTransform transform(kFullTurn, box.center(), 0.5F * box.sizes().norm());
  for (const WallPoint& wall : walls) {
    const float facing = std::atan2(wall.normal.y(), wall.normal.x());
    const int middle = static_cast<int>(
        std::lround(facing * static_cast<float>(kHalfTurn) / std::numbers::pi_v<float>));
    for (int off = -kOrientedWindow; off <= kOrientedWindow; ++off) {
      transform.vote((middle + off + kFullTurn) % kFullTurn, wall.p, wall.length_m);
    }
  }
  return transform.spectrum();
}

Spectrum circular_correlation(const Spectrum& a, const Spectrum& b) {
  LIFELINE_CHECK(a.size() == b.size());
  const std::size_t n = a.size();
  Spectrum correlation(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) correlation[k] += a[i] * b[(i + n - k) % n];
  }
  return correlation;
}

std::vector<SpectrumPeak> circular_maxima(const Spectrum& values, std::size_t separation,
                                          std::size_t count) {
  const std::size_t n = values.size();
  std::vector<SpectrumPeak> peaks;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = values[(i + n - 1) % n], here = values[i], after = values[(i + 1) % n];
    if (here <= 0 || here < before || here <= after) continue;
    const double bend = before - 2 * here + after;
    const double shift = bend < 0 ? 0.5 * (before - after) / bend : 0.0;
    peaks.push_back({std::fmod(static_cast<double>(i + n) + shift, static_cast<double>(n)), here});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const auto& a, const auto& b) { return a.value > b.value; });
  std::vector<SpectrumPeak> kept;
  for (const SpectrumPeak& peak : peaks) {
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const SpectrumPeak& other) {
      const double gap = std::abs(peak.bin - other.bin);
      return std::min(gap, static_cast<double>(n) - gap) >= static_cast<double>(separation);
    });
    if (apart) kept.push_back(peak);
    if (kept.size() == count) break;
  }
  return kept;
}

}  // namespace lifeline::matching
