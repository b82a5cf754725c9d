#include "coordinator/matching/match_maps.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "coordinator/matching/acceptance.hpp"
#include "coordinator/matching/match_oriented.hpp"
#include "coordinator/matching/match_spectra.hpp"
#include "coordinator/matching/stop_watch.hpp"

namespace lifeline::matching {
namespace {

/// Which of the two maps is searched in: a property of the maps, not of the order they came in.
bool comes_first(const MapFeatures& a, const MapFeatures& b) {
  const auto key = [](const MapFeatures& f) {
    return std::make_tuple(f.walls.size(), f.known_m2, f.wall_m, f.origin_map_m.x(),
                           f.origin_map_m.y());
  };
  return key(a) >= key(b);
}

/// The match of b with a, told as one of a with b.
void swap_roles(MatchResult& result) {
  if (result.candidates.empty()) return;
  const Pose2 T = result.candidates.front().T_a_b;
  result.overlap_centre_b_m = T * result.overlap_centre_b_m;
  // Derivative of the inverse transform's x, y and yaw by those of the transform.
  const Pose2 inverse = T.inverse();
  const double c = std::cos(T.yaw_rad), s = std::sin(T.yaw_rad);
  Eigen::Matrix3d jacobian;
  jacobian << -c, -s, inverse.y_m, s, -c, -inverse.x_m, 0, 0, -1;
  result.covariance = jacobian * result.covariance * jacobian.transpose();
  for (MatchCandidate& candidate : result.candidates) candidate.T_a_b = candidate.T_a_b.inverse();
}

MatchResult search(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config) {
  return config.method == Method::spectra ? match_spectra(a, b, config)
                                          : match_oriented(a, b, config);
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::wait:
      return "wait";
    case Verdict::rejected:
      break;
  }
  return "rejected";
}

const char* to_string(Method method) {
  return method == Method::spectra ? "spectra" : "oriented";
}

MatchResult match_maps(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config) {
  StopWatch whole;
  MatchResult result;
  // Cell sizes come from files: equal ones may differ in the last digits.
  if (std::abs(a.cell_size_m - b.cell_size_m) > 1e-6) {
    result.verdict = Verdict::rejected;
    result.reason = fmt::format("the cells of one map are {} m wide, of the other {} m",
                                a.cell_size_m, b.cell_size_m);
  } else {
    const bool in_order = comes_first(a, b);
    result = in_order ? search(a, b, config) : search(b, a, config);
    if (!in_order) swap_roles(result);
    judge(a, b, config, result);
    if (result.accepted() && config.method == Method::oriented) {
      // Costs as much as the match: asked only of what is about to be believed.
      StopWatch watch;
      const double least =
          least_control_share(limits_for(a, b, config)) * result.candidates.front().score;
      result.control_score = in_order ? best_score(a, *b.mirror, config, least)
                                      : best_score(b, *a.mirror, config, least);
      result.steps_ms.control = watch.lap_ms();
      judge(a, b, config, result);
    }
  }
  result.match_ms = whole.lap_ms();
  return result;
}

}  // namespace lifeline::matching
