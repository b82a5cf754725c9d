#include "agents/run_settings.hpp"

#include <utility>

#include "agents/agent_settings.hpp"
#include "common/base/log.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

// Nothing where nothing is to be kept, or the disk refuses.
Result<std::unique_ptr<HelmetStorage>> open_storage(const proto::AgentConfig& config,
                                                    const sharing::Speaker& speaker, Floor floor,
                                                    const Clock& clock) {
  if (config.storage().folder() == "off") {
    spdlog::info("keeps nothing on disk: a restart begins a new map (storage.folder or --state)");
    return nullptr;
  }
  store::ResumeLimits limits;
  limits.oldest = from_seconds(3600.0 * config.storage().resume_within_h());
  return HelmetStorage::open(config.storage().folder(),
                             {"helmet", speaker.id.text(), speaker.mission_id,
                              to_settings(config).geometry, speaker.incarnation.value},
                             floor, limits, clock);
}

Result<hud::HudFeed> start_hud(const hud::HudOptions& options, double cell_size_m,
                               HelmetStorage* storage) {
  if (!options.wanted()) return hud::HudFeed(nullptr);
  hud::Path earlier;
  if (storage != nullptr && storage->memory().mapper) {
    for (const auto& stamped : storage->memory().mapper->trajectory)
      earlier.push_back(stamped.pose.translation());
  }
  auto hud = hud::Hud::start(options, cell_size_m, earlier);
  if (!hud) return forward_error(hud);
  return hud::HudFeed(*std::move(hud));
}

std::optional<HelmetRecordingOptions> recording_options(const proto::RecordingConfig& config) {
  if (config.folder() == "off") return std::nullopt;
  return HelmetRecordingOptions{config.folder(), config.scans(),
                                from_seconds(config.map_interval_s())};
}

}  // namespace

Result<proto::AgentConfig> read_run_config(const AgentRunOptions& options) {
  auto config = read_agent_config(options.config, options.matcher);
  if (!config) return config;
  if (options.mission) config->mutable_mission()->set_mission_id(*options.mission);
  if (options.domain) config->mutable_mission()->set_domain_id(*options.domain);
  if (options.state) config->mutable_storage()->set_folder(options.state->string());
  if (options.record) config->mutable_recording()->set_folder(options.record->string());
  if (options.budget_bit_s) config->mutable_sharing()->set_budget_bit_s(*options.budget_bit_s);
  return config;
}

Result<Beside> open_beside(const AgentRunOptions& options, const proto::AgentConfig& config,
                           const sharing::Speaker& speaker, Floor floor, const Clock& clock) {
  auto storage = open_storage(config, speaker, floor, clock);
  if (!storage) return forward_error(storage);
  auto hud = start_hud(options.hud, to_settings(config).geometry.cell_size_m, storage->get());
  if (!hud) return forward_error(hud);
  return Beside{*std::move(storage), *std::move(hud), recording_options(config.recording())};
}

}  // namespace lifeline
