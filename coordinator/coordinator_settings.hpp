#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::proto {
class CoordinatorConfig;
class GridConfig;
}  // namespace lifeline::proto

namespace lifeline {

/// The configuration with every default filled in; a mission or domain of the command line
/// overrides the file's. Errors as of load_coordinator_config.
[[nodiscard]] Result<proto::CoordinatorConfig> read_coordinator_config(
    const std::optional<std::filesystem::path>& file, const std::optional<std::string>& mission,
    const std::optional<std::uint32_t>& domain);

/// The schema's values as the coordinator's parts take them; the values were checked when the file
/// was read.
[[nodiscard]] CoordinatorSettings to_settings(const proto::CoordinatorConfig& config,
                                              sharing::Speaker speaker);
[[nodiscard]] matching::MatchConfig to_match_config(const proto::CoordinatorConfig& config);

}  // namespace lifeline
