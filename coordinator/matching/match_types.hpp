#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/grid/pose2.hpp"

namespace lifeline::matching {

/// How T_G is looked for.
enum class Method {
  oriented,  ///< oriented walls: spectrum over the full circle, 2D correlation, sub-cell refinement
  spectra,   ///< the paper's section 3.3: Hough spectrum, x and y spectra, Eq. 12 and 13 alone
};

/// What the default path asks for beyond s_0 and the acceptance index; how the values were found is
/// told in docs/decisions/0301 to 0306.
struct AcceptanceLimits {
  double min_agreeing_wall_m = 4.0;   ///< less could be chance
  double max_conflict = 0.08;         ///< of the wall that speaks for or against, where much speaks
  double min_conflict = 0.03;         ///< the same where next to nothing speaks; linear in between
  double much_wall_m = 14.0;          ///< agreeing wall from which on max_conflict counts
  double max_conflict_piece_m = 6.0;  ///< in one piece: a wall, no person and no door
  double min_margin = 0.5;            ///< by which the best leads the second hypothesis
  double min_control_ratio = 2.0;     ///< to the score that the mirror image of a map gets
  /// Margin, mirror image and agreeing area together: each of them may be small, not all at once.
  double min_lead = 12.0;
  double max_bend_rad_per_m =
      0.04 * std::numbers::pi / 180.0;  ///< more than one rigid transform can do for
  double min_bend_sds = 3.0;            ///< a smaller bend may be the walls' noise
  double min_constraint_m = 0.8;        ///< else the maps could slide along each other
};

/// What is asked of two layers, which tell how well they saw and will grow (docs/decisions/0305).
[[nodiscard]] constexpr AcceptanceLimits layer_limits() {
  AcceptanceLimits limits;
  limits.min_agreeing_wall_m = 10.0;
  limits.max_conflict = 0.05;
  limits.min_margin = 0.65;
  limits.min_lead = 0.0;  // so much wall and margin stand out enough: tried on 30,000 negatives
  return limits;
}

/// What the caller may choose. The defaults are those of the configuration schema.
struct MatchConfig {
  Method method = Method::oriented;
  double area_x_m = 30.0;  ///< mission area: gridx * gridy of Eq. 12, in metres
  double area_y_m = 30.0;
  double min_s_overlapping = 0.01;       ///< s_0 of Eq. 12
  double min_acceptance_index = 0.85;    ///< of Eq. 13
  std::size_t rotation_candidates = 10;  ///< how many peaks of the spectra's correlation are tried
  AcceptanceLimits limits = {};          ///< where a map is a picture: it has no weights
  AcceptanceLimits layer_limits = matching::layer_limits();
};

/// One way to lay map b on map a, with the figures that speak for and against it.
struct MatchCandidate {
  Pose2 T_a_b;                    ///< takes b's map coordinates to a's
  double s_overlapping = 0.0;     ///< Eq. 12
  double acceptance_index = 0.0;  ///< Eq. 13
  double agreeing_wall_m = 0.0;   ///< length of wall that both maps saw, facing the same way
  double wall_agreement = 0.0;    ///< share of the wall in jointly seen area that agrees, 0 to 1
  double conflict = 0.0;          ///< share of that wall which stands in the other map's free space
  /// The longest connected piece of contradicting wall: furniture and doors that moved are short,
  /// walls of another building are not.
  double longest_conflict_m = 0.0;
  double constraint_m = 0.0;  ///< agreeing wall across the worst fixed direction of sliding
  double score = 0.0;         ///< agreeing less contradicting wall, in metres
};

/// How much the maps are bent against each other where they overlap: by heading drift the rotation
/// that lays one on the other changes from place to place.
struct Bend {
  double rate_rad_per_m = 0.0;     ///< change of the rotation per metre
  double rate_sd_rad_per_m = 1.0;  ///< standard deviation of the rate
  double over_overlap_rad = 0.0;   ///< rate times the extent of the shared walls
};

enum class Verdict {
  accepted,  ///< the maps may be merged by T_a_b
  wait,      ///< not decided: the maps must grow first
  rejected,  ///< what the maps share contradicts each other
};

[[nodiscard]] const char* to_string(Verdict verdict);
[[nodiscard]] const char* to_string(Method method);

/// Where the time of one match went; the default path alone fills it in. Milliseconds
/// of CPU time.
struct StepTimes {
  double search = 0.0;   ///< spectra and correlation
  double refine = 0.0;   ///< of all hypotheses
  double figures = 0.0;  ///< of what is reported, and the bend
  double control = 0.0;  ///< the mirror image
};

/// The evidence of one match. `candidates` is ordered from best to worst, each a distinct
/// hypothesis; it is empty when there was nothing to compare.
struct MatchResult {
  Verdict verdict = Verdict::wait;
  std::string reason;  ///< one sentence, at most 256 characters
  std::vector<MatchCandidate> candidates;
  double margin =
      0.0;  ///< 1 - score of the second hypothesis / score of the best; 1 with no second
  /// Score of the best place of b's mirror image on a, where that was asked for: what walls of this
  /// style give by chance.
  std::optional<double> control_score;
  double lead = 0.0;         ///< how far the best stands out from chance; 0 without control_score
  std::optional<Bend> bend;  ///< of the best candidate; only Method::oriented measures it
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the best T_a_b: x_m, y_m, yaw_rad
  Eigen::Vector2d overlap_centre_b_m{0.0, 0.0};  ///< middle of the agreeing wall, in b's frame
  double match_ms = 0.0;                         ///< CPU time of match_maps alone
  StepTimes steps_ms;

  [[nodiscard]] bool accepted() const { return verdict == Verdict::accepted; }
};

}  // namespace lifeline::matching
