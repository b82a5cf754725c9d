#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "agents/helmet_mapper.hpp"
#include "agents/sensing/raw_scan.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "coordinator/matching/match_types.hpp"

namespace lifeline::bench {

/// One of the paper's experiments: its building, and its column of Table 1.
struct PaperExperiment {
  int number;
  const char* building;  ///< as `sim:` calls it
  double beta_percent;   ///< of Eq. 11
  double min_acceptance_index;
  double min_s_overlapping;
};

inline constexpr std::array<PaperExperiment, 4> kPaperExperiments{{
    {1, "testbed", 5.0, 0.95, 0.03},
    {2, "rearranged", 5.0, 0.95, 0.03},
    {3, "meeting", 4.0, 0.85, 0.02},
    {4, "karaoke", 2.5, 0.85, 0.02},
}};

/// What places the scans.
enum class Method {
  conventional,  ///< the paper's comparison: ray-cast model, RANSAC, ICP; no attitude but for Eq.
                 ///< 14
  advanced,      ///< the paper's: the same, with Algorithm 1 and GICP from Eq. 5
  ours,          ///< the default
};
inline constexpr std::array<Method, 3> kMethods{Method::conventional, Method::advanced,
                                                Method::ours};
[[nodiscard]] const char* name_of(Method method);

/// What two rescuers saw in one building.
struct PaperWalk {
  sources::FloorPlan plan;
  std::array<std::vector<sensing::RawScan>, 2> scans;
};

/// Two rescuers with a lidar of 400 beams, all taken at once, at 10 Hz walk the building `seed` for
/// `duration_s`; doors beside them open and close, heads move as people move them.
[[nodiscard]] PaperWalk walk_through(const PaperExperiment& experiment, std::uint64_t seed,
                                     double duration_s);

/// A scan as the method takes it: the conventional one knows of no yaw.
[[nodiscard]] sensing::RawScan as_seen_by(Method method, const sensing::RawScan& raw);

/// A helmet that maps by this method.
[[nodiscard]] std::unique_ptr<HelmetMapper> make_helmet(Method method);

/// The paper's matching (section 3.3) or ours, with the experiment's thresholds.
[[nodiscard]] matching::MatchConfig match_config(const PaperExperiment& experiment,
                                                 matching::Method method);

/// Takes coordinates of the second rescuer's map to the first one's: both maps begin at a true
/// pose.
[[nodiscard]] Pose2 true_T_map1_map2(const PaperWalk& walk);

}  // namespace lifeline::bench
