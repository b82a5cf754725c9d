#include "coordinator/coordinator_settings.hpp"

#include "common/files/load_config.hpp"
#include "idl/config.pb.h"

namespace lifeline {

Result<proto::CoordinatorConfig> read_coordinator_config(
    const std::optional<std::filesystem::path>& file, const std::optional<std::string>& mission,
    const std::optional<std::uint32_t>& domain) {
  proto::CoordinatorConfig config;
  files::fill_defaults(config);
  if (file) {
    auto loaded = files::load_coordinator_config(*file);
    if (!loaded) return loaded;
    config = *std::move(loaded);
  }
  if (mission) config.mutable_mission()->set_mission_id(*mission);
  if (domain) config.mutable_mission()->set_domain_id(*domain);
  return config;
}

CoordinatorSettings to_settings(const proto::CoordinatorConfig& config, sharing::Speaker speaker) {
  const auto& merging = config.merging();
  return {std::move(speaker),
          {config.grid().cell_size_m(), config.grid().truncation_m()},
          {merging.min_explored_percent(), merging.area_x_m(), merging.area_y_m(),
           merging.rematch_growth_percent()},
          {.own_weight = merging.own_weight()}};
}

matching::MatchConfig to_match_config(const proto::CoordinatorConfig& config) {
  const auto& merging = config.merging();
  matching::MatchConfig match;
  match.method =
      merging.matching() == "spectra" ? matching::Method::spectra : matching::Method::oriented;
  match.area_x_m = merging.area_x_m();
  match.area_y_m = merging.area_y_m();
  match.min_s_overlapping = merging.min_s_overlapping();
  match.min_acceptance_index = merging.min_acceptance_index();
  return match;
}

}  // namespace lifeline
