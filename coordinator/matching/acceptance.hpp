#pragma once

#include <numbers>

#include "coordinator/matching/map_features.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::matching {

/// What the default path asks for beyond s_0 and the acceptance index; how the values were found is
/// told in docs/decisions/0301-a-mirror-image-tells-what-chance-gives.md.
struct AcceptanceLimits {
  double min_agreeing_wall_m = 4.0;  ///< less could be chance
  double max_conflict = 0.12;        ///< of the wall that speaks for or against, where much speaks
  double min_conflict = 0.03;        ///< the same where next to nothing speaks; linear in between
  double much_wall_m = 20.0;         ///< agreeing wall from which on max_conflict counts
  double min_margin = 0.5;           ///< by which the best leads the second hypothesis
  double min_control_ratio = 2.0;    ///< to the score that the mirror image of a map gets
  double max_bend_rad_per_m =
      0.04 * std::numbers::pi / 180.0;  ///< more than one rigid transform can do for
  double min_bend_sds = 3.0;            ///< a smaller bend may be the walls' noise
  double min_constraint_m = 0.8;        ///< else the maps could slide along each other
};

/// Fills in margin, verdict and reason from the candidates of `result`. In doubt the verdict is
/// wait: maps grow. With Method::spectra the paper's two criteria decide alone.
void judge(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config,
           MatchResult& result);

}  // namespace lifeline::matching
