#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "common/sharing/fleet_detection.hpp"

namespace lifeline::files {

/// The fleet's list of finds as reports hold it (docs/files.md names the fields).
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<sharing::FleetDetection>& finds);

}  // namespace lifeline::files
