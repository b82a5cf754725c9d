#include "coordinator/matching/candidate.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "coordinator/matching/compare_walls.hpp"
#include "coordinator/matching/overlap.hpp"

namespace lifeline::matching {
namespace {

Pose2 shift_by(const Eigen::Vector2d& t) {
  return {t.x(), t.y(), 0.0};
}

}  // namespace

Pose2 to_map_frames(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b_local) {
  return shift_by(a.origin_map_m) * T_a_b_local * shift_by(-b.origin_map_m);
}

Pose2 to_local_frames(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b) {
  return shift_by(-a.origin_map_m) * T_a_b * shift_by(b.origin_map_m);
}

MeasuredCandidate measure_candidate(const MapFeatures& a, const MapFeatures& b,
                                    const Pose2& T_a_b_local, const MatchConfig& config) {
  const WallFigures b_on_a = compare_walls(b.walls, T_a_b_local, a, kFineGate);
  const WallFigures a_on_b = compare_walls(a.walls, T_a_b_local.inverse(), b, kFineGate);
  const Overlap overlap = count_overlap(a.filtered, b.filtered, T_a_b_local);
  const double area_cells = config.area_x_m * config.area_y_m / (a.cell_size_m * a.cell_size_m);

  MeasuredCandidate measured;
  MatchCandidate& candidate = measured.candidate;
  candidate.T_a_b = to_map_frames(a, b, T_a_b_local);
  candidate.s_overlapping = overlap.s_overlapping(area_cells);
  candidate.acceptance_index = overlap.acceptance_index();
  const double agreeing = 0.5 * (b_on_a.agreeing_m + a_on_b.agreeing_m);
  const double conflicting = 0.5 * (b_on_a.conflicting_m + a_on_b.conflicting_m);
  const double judged = 0.5 * (b_on_a.judged_m() + a_on_b.judged_m());
  candidate.agreeing_wall_m = agreeing;
  candidate.wall_agreement = judged > 0 ? agreeing / judged : 0.0;
  candidate.conflict = conflicting > 0 ? conflicting / (agreeing + conflicting) : 0.0;
  candidate.longest_conflict_m = std::max(longest_conflict_m(b.walls, T_a_b_local, a),
                                          longest_conflict_m(a.walls, T_a_b_local.inverse(), b));
  // How much wall stands across the direction in which the maps would slide most easily.
  const Eigen::Matrix2d spread = b_on_a.spread + a_on_b.spread;
  candidate.constraint_m =
      0.5 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvalues()(0);
  candidate.score = agreeing - kConflictWeight * conflicting;
  if (b_on_a.agreeing_m > 0) {
    measured.overlap_centre_b_m = b.origin_map_m + b_on_a.moment / b_on_a.agreeing_m;
  }
  return measured;
}

}  // namespace lifeline::matching
