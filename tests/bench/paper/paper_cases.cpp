#include "tests/bench/paper/paper_cases.hpp"

#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "agents/sources/open_source.hpp"
#include "agents/sources/simulator/simulated_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::bench {
namespace {

template <typename T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text);
  return *std::move(result);
}

}  // namespace

const char* name_of(Method method) {
  switch (method) {
    case Method::conventional:
      return "conventional";
    case Method::advanced:
      return "advanced";
    case Method::ours:
      break;
  }
  return "ours";
}

PaperWalk walk_through(const PaperExperiment& experiment, std::uint64_t seed, double duration_s) {
  PaperWalk walk;
  for (std::size_t rescuer = 0; rescuer < walk.scans.size(); ++rescuer) {
    const auto spec = value_of(sources::parse_source_spec(
        fmt::format("sim:{}?seed={}&walkers=2&walker={}&duration={}&beams=400&head=natural"
                    "&doors=beside",
                    experiment.building, seed, rescuer, duration_s)));
    if (rescuer == 0) walk.plan = value_of(sources::load_plan(spec));
    const auto source = value_of(sources::open_simulated_source(spec));
    while (auto scan = value_of(source->next())) walk.scans[rescuer].push_back(*std::move(scan));
  }
  return walk;
}

sensing::RawScan as_seen_by(Method method, const sensing::RawScan& raw) {
  sensing::RawScan scan = raw;
  if (method == Method::conventional && scan.attitude) {
    scan.attitude->yaw_rad = std::numeric_limits<double>::quiet_NaN();
  }
  return scan;
}

std::unique_ptr<HelmetMapper> make_helmet(Method method) {
  slam::SlamConfig config;
  if (method == Method::conventional) config.matcher = slam::Matcher::conventional;
  if (method == Method::advanced) config.matcher = slam::Matcher::advanced;
  return std::make_unique<HelmetMapper>(config, GridGeometry{}, sensing::ProjectionConfig{});
}

matching::MatchConfig match_config(const PaperExperiment& experiment, matching::Method method) {
  matching::MatchConfig config;
  config.method = method;
  if (method == matching::Method::spectra) {
    config.min_acceptance_index = experiment.min_acceptance_index;
    config.min_s_overlapping = experiment.min_s_overlapping;
  }
  return config;
}

Pose2 true_T_map1_map2(const PaperWalk& walk) {
  return walk.scans[0].front().T_world_head_truth->inverse() *
         *walk.scans[1].front().T_world_head_truth;
}

}  // namespace lifeline::bench
