#include "coordinator/matching/match_spectra.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include "coordinator/matching/axis_spectra.hpp"
#include "coordinator/matching/candidate.hpp"
#include "coordinator/matching/hough_spectrum.hpp"
#include "coordinator/matching/hypotheses.hpp"
#include "coordinator/matching/overlap.hpp"
#include "coordinator/matching/preprocess.hpp"
#include "coordinator/matching/refine.hpp"

namespace lifeline::matching {
namespace {

constexpr std::size_t kShiftsPerAxis = 2;
constexpr int kShiftSeparation = 10;  // cells
constexpr std::size_t kReportedBySpectra = 6;

double radians(double bins) {
  return bins * std::numbers::pi / (180.0 * static_cast<double>(kSpectrumBinsPerDegree));
}

/// What does not change from rotation to rotation.
struct Problem {
  OccupancyGrid a, b;  ///< pre-processed
  Spectrum hough_a;
  double alignment_rad;   ///< turns a so that its strongest walls run along the axes
  AxisSpectra spectra_a;  ///< of a so turned
};

Problem prepare(const MapFeatures& a, const MapFeatures& b) {
  Problem problem{close_borders(a.filtered), close_borders(b.filtered), {}, 0.0, {}};
  problem.hough_a = hough_spectrum(problem.a);
  const auto strongest = std::max_element(problem.hough_a.begin(), problem.hough_a.end());
  problem.alignment_rad = -radians(static_cast<double>(strongest - problem.hough_a.begin()));
  problem.spectra_a = axis_spectra(problem.a, problem.alignment_rad);
  return problem;
}

/// The translations that the x and y spectra propose at one rotation, with their scores.
void add_translations(const Problem& problem, double yaw_rad, double s0_cells,
                      std::vector<Hypothesis>& hypotheses) {
  const AxisSpectra& spectra_a = problem.spectra_a;
  const AxisSpectra spectra_b = axis_spectra(problem.b, problem.alignment_rad + yaw_rad);
  const auto shifts_x =
      correlation_maxima(spectra_a.x, spectra_b.x, kShiftSeparation, kShiftsPerAxis);
  const auto shifts_y =
      correlation_maxima(spectra_a.y, spectra_b.y, kShiftSeparation, kShiftsPerAxis);
  for (const int x : shifts_x) {
    for (const int y : shifts_y) {
      // In a's aligned frame, then back to its own.
      const Eigen::Vector2d t =
          spectra_a.first_m - spectra_b.first_m + problem.a.cell_size_m * Eigen::Vector2d(x, y);
      const Eigen::Vector2d back = Pose2{0.0, 0.0, -problem.alignment_rad} * t;
      const Pose2 T_a_b{back.x(), back.y(), normalise_angle(yaw_rad)};
      const Overlap overlap = count_overlap(problem.a, problem.b, T_a_b);
      const bool reaches_s0 = static_cast<double>(overlap.agreeing) > s0_cells;
      hypotheses.push_back({T_a_b, overlap.acceptance_index() + (reaches_s0 ? 1.0 : 0.0)});
    }
  }
}

}  // namespace

MatchResult match_spectra(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config) {
  MatchResult result;
  if (a.filtered.cells.empty() || b.filtered.cells.empty()) return result;
  const Problem problem = prepare(a, b);
  const Spectrum correlation = circular_correlation(problem.hough_a, hough_spectrum(problem.b));
  const double s0_cells = config.min_s_overlapping * config.area_x_m * config.area_y_m /
                          (a.cell_size_m * a.cell_size_m);
  std::vector<Hypothesis> hypotheses;
  const std::size_t peaks = std::max<std::size_t>(1, config.rotation_candidates / 2);
  for (const SpectrumPeak& peak : circular_maxima(correlation, kRotationSeparation, peaks)) {
    for (const double half_turn : {0.0, std::numbers::pi}) {
      add_translations(problem, radians(peak.bin) + half_turn, s0_cells, hypotheses);
    }
  }
  keep_best(hypotheses, hypotheses.size());
  const Eigen::Vector2d middle_b =
      0.5 * b.cell_size_m * Eigen::Vector2d(b.filtered.columns, b.filtered.rows);
  keep_distinct(hypotheses, middle_b);
  keep_best(hypotheses, kReportedBySpectra);
  for (const Hypothesis& h : hypotheses) {
    const MeasuredCandidate measured = measure_candidate(a, b, h.T_a_b, config);
    if (result.candidates.empty()) {
      result.overlap_centre_b_m = measured.overlap_centre_b_m;
      result.covariance = covariance_in_map_frames(a, b, h.T_a_b);
    }
    result.candidates.push_back(measured.candidate);
  }
  return result;
}

}  // namespace lifeline::matching
