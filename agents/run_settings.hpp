#pragma once

#include <memory>
#include <optional>

#include "agents/hud/hud_feed.hpp"
#include "agents/recording/helmet_recording.hpp"
#include "agents/run_command.hpp"
#include "agents/storage/helmet_storage.hpp"

namespace lifeline::proto {
class AgentConfig;
}  // namespace lifeline::proto

namespace lifeline {

/// The file's configuration, or the defaults, with what the command line overrides.
[[nodiscard]] Result<proto::AgentConfig> read_run_config(const AgentRunOptions& options);

/// What a helmet keeps and shows beside the mission.
struct Beside {
  std::unique_ptr<HelmetStorage> storage;  ///< nullptr: nothing is kept
  hud::HudFeed hud;
  std::optional<HelmetRecordingOptions> recording;  ///< empty: nothing is recorded
};

/// Opens the state and the HUD, which begins where the wearer came in, also before a restart.
[[nodiscard]] Result<Beside> open_beside(const AgentRunOptions& options,
                                         const proto::AgentConfig& config,
                                         const sharing::Speaker& speaker, Floor floor,
                                         const Clock& clock);

}  // namespace lifeline
