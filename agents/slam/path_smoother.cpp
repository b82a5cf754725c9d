#include "agents/slam/path_smoother.hpp"

#include <Eigen/LU>

#include "agents/slam/motion_model.hpp"

namespace lifeline::slam {
namespace {

constexpr double kFirstSigma_m = 1.0;
constexpr double kFirstSigma_m_s = 2.0;  ///< of the velocity before anything is known of it

/// Before and after a scan's fix.
struct Filtered {
  WalkState predicted, filtered;
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  bool begins = true;  ///< nothing leads here from the state before
};

std::vector<Filtered> filter(std::span<const PathPlace> path, const SmoothConfig& config) {
  const WalkFilter walk(config.acceleration_m_s2);
  std::vector<Filtered> states;
  states.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathPlace& place = path[i];
    const double dt_s = i == 0 ? 0.0 : to_seconds(place.stamp - path[i - 1].stamp);
    Filtered state;
    state.predicted = WalkFilter::begin(place.p_map_m, kFirstSigma_m, kFirstSigma_m_s);
    if (dt_s > 0.0 && dt_s <= kLongestStep_s) {
      const WalkState next = walk.after(states.back().filtered, dt_s, dt_s);
      if (WalkFilter::sigmas_off(next, place.p_map_m, place.fix) <= config.max_sigmas) {
        state = {next, {}, WalkFilter::transition(dt_s), false};
      }
    }
    state.filtered = WalkFilter::take_in(state.predicted, place.p_map_m, place.fix);
    states.push_back(state);
  }
  return states;
}

}  // namespace

std::vector<Eigen::Vector2d> smooth_path(std::span<const PathPlace> path,
                                         const SmoothConfig& config) {
  const std::vector<Filtered> states = filter(path, config);
  std::vector<Eigen::Vector2d> smoothed(states.size());
  Eigen::Vector4d after = Eigen::Vector4d::Zero();
  for (std::size_t i = states.size(); i-- > 0;) {
    const Filtered& here = states[i];
    Eigen::Vector4d best = here.filtered.mean;
    if (i + 1 < states.size() && !states[i + 1].begins) {
      const Filtered& next = states[i + 1];
      const Eigen::Matrix4d gain = here.filtered.covariance * next.transition.transpose() *
                                   next.predicted.covariance.inverse();
      best += gain * (after - next.predicted.mean);
    }
    smoothed[i] = best.head<2>();
    after = best;
  }
  return smoothed;
}

}  // namespace lifeline::slam
