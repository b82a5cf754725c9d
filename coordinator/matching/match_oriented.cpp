#include "coordinator/matching/match_oriented.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "coordinator/matching/bend.hpp"
#include "coordinator/matching/candidate.hpp"
#include "coordinator/matching/compare_walls.hpp"
#include "coordinator/matching/correlate_walls.hpp"
#include "coordinator/matching/hypotheses.hpp"
#include "coordinator/matching/refine.hpp"
#include "coordinator/matching/stop_watch.hpp"

namespace lifeline::matching {
namespace {

// Each stage keeps fewer hypotheses and looks at them more closely.
constexpr std::size_t kPeaksPerRotation = 24;
constexpr std::size_t kPeaks = 128;
constexpr std::size_t kRefinedCoarsely = 64;
constexpr std::size_t kRefinedFully = 12;
constexpr std::size_t kReported = 4;
/// Hypotheses that score less than this share of the best one cannot become its rivals any more: by
/// refinement scores grow, but not by so much.
constexpr double kHopefulRough = 0.15;
constexpr double kHopefulCoarse = 0.30;
constexpr std::size_t kAlwaysRefined = 2;  ///< so that there is a second to compare with
/// In the correlation positions are rough, and so are conflicts: they count less than at the end.
constexpr float kSearchConflictWeight = 1.5F;
constexpr WallGate kSearchGate{0.25F, 0.80F};
constexpr WallGate kCoarseGate{0.15F, 0.85F};
constexpr std::array<float, 6> kCoarseScales_m{0.30F, 0.25F, 0.20F, 0.15F, 0.12F, 0.10F};
constexpr std::array<float, 6> kFineScales_m{0.12F, 0.09F, 0.07F, 0.05F, 0.05F, 0.05F};

double score_of(const WallFigures& b_on_a, const WallFigures& a_on_b) {
  return 0.5 * (b_on_a.agreeing_m + a_on_b.agreeing_m -
                kConflictWeight * (b_on_a.conflicting_m + a_on_b.conflicting_m));
}

double coarse_score(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b,
                    const WallGate& gate) {
  return score_of(compare_walls(b.skeleton, T_a_b, a, gate),
                  compare_walls(a.skeleton, T_a_b.inverse(), b, gate));
}

double fine_score(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b) {
  return score_of(compare_walls(b.walls, T_a_b, a, kFineGate),
                  compare_walls(a.walls, T_a_b.inverse(), b, kFineGate));
}

Eigen::Vector2d middle_of(const std::vector<WallPoint>& walls) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const WallPoint& wall : walls) sum += wall.p.cast<double>();
  return walls.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(walls.size()));
}

/// Of hypotheses from best to worst, drops those below `share` of the best one, or of `least` where
/// that is more.
void drop_hopeless(std::vector<Hypothesis>& hypotheses, double share, double least) {
  if (hypotheses.empty()) return;
  const double bound = share * std::max(hypotheses.front().score, least);
  const std::size_t always = least > 0.0 ? 0 : kAlwaysRefined;
  while (hypotheses.size() > always && hypotheses.back().score < bound) hypotheses.pop_back();
}

/// The highest peaks of the correlation, over all rotations that the spectra propose. `least`: as
/// of refine_all().
std::vector<Hypothesis> search(const MapFeatures& a, const MapFeatures& b, std::size_t rotations,
                               double least) {
  const Spectrum correlation = circular_correlation(a.oriented, b.oriented);
  std::vector<Hypothesis> hypotheses;
  for (const SpectrumPeak& peak : circular_maxima(correlation, kRotationSeparation, rotations)) {
    const double yaw_rad =
        peak.bin / static_cast<double>(correlation.size()) * 2 * std::numbers::pi;
    for (const CorrelationPeak& found :
         correlate_walls(a, b, yaw_rad, kSearchConflictWeight, kPeaksPerRotation)) {
      hypotheses.push_back({found.T_a_b, static_cast<double>(found.value)});
    }
  }
  keep_best(hypotheses, kPeaks);
  if (least > 0.0) drop_hopeless(hypotheses, kHopefulRough, least);
  for (Hypothesis& h : hypotheses) h.score = coarse_score(a, b, h.T_a_b, kSearchGate);
  keep_best(hypotheses, kRefinedCoarsely);
  return hypotheses;
}

/// All on the skeletons first, then the best and distinct ones on all walls. `least`: a score below
/// which a place is of no interest.
void refine_all(const MapFeatures& a, const MapFeatures& b, double least,
                std::vector<Hypothesis>& hypotheses) {
  const Eigen::Vector2d p_b = middle_of(b.skeleton);
  drop_hopeless(hypotheses, kHopefulRough, least);
  for (Hypothesis& h : hypotheses) {
    h.T_a_b = refine(a, b, h.T_a_b, kCoarseScales_m, WallDetail::skeleton);
    h.score = coarse_score(a, b, h.T_a_b, kCoarseGate);
  }
  keep_best(hypotheses, hypotheses.size());
  keep_distinct(hypotheses, p_b);
  keep_best(hypotheses, kRefinedFully);
  drop_hopeless(hypotheses, kHopefulCoarse, least);
  for (Hypothesis& h : hypotheses) {
    h.T_a_b = refine(a, b, h.T_a_b, kFineScales_m, WallDetail::all);
    h.score = fine_score(a, b, h.T_a_b);
  }
  keep_best(hypotheses, hypotheses.size());
  keep_distinct(hypotheses, p_b);
  keep_best(hypotheses, kReported);
}

}  // namespace

MatchResult match_oriented(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config) {
  MatchResult result;
  StopWatch watch;
  std::vector<Hypothesis> hypotheses = search(a, b, config.rotation_candidates, 0.0);
  result.steps_ms.search = watch.lap_ms();
  refine_all(a, b, 0.0, hypotheses);
  result.steps_ms.refine = watch.lap_ms();
  for (const Hypothesis& h : hypotheses) {
    const MeasuredCandidate measured = measure_candidate(a, b, h.T_a_b, config);
    if (result.candidates.empty()) {
      result.overlap_centre_b_m = measured.overlap_centre_b_m;
      const Eigen::Vector2d centre_b = measured.overlap_centre_b_m - b.origin_map_m;
      result.bend = estimate_bend(a, b, h.T_a_b, h.T_a_b * centre_b);
      result.covariance = covariance_in_map_frames(a, b, h.T_a_b);
    }
    result.candidates.push_back(measured.candidate);
  }
  result.steps_ms.figures = watch.lap_ms();
  return result;
}

double best_score(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config,
                  double least) {
  std::vector<Hypothesis> hypotheses = search(a, b, config.rotation_candidates, least);
  refine_all(a, b, least, hypotheses);
  return hypotheses.empty() ? 0.0 : std::max(0.0, hypotheses.front().score);
}

}  // namespace lifeline::matching
