#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/result.hpp"
#include "deploy/demo/fleet_plan.hpp"
#include "deploy/demo/summary.hpp"

namespace lifeline::demo {

/// Makes the folder where it is missing, makes sure that it can be written to, and takes out what
/// an earlier demo left there. unavailable, naming folder and reason, otherwise.
[[nodiscard]] Result<void> prepare_report_folder(const std::filesystem::path& folder);

/// The JSON object in `file`, or null where there is none that can be read.
[[nodiscard]] nlohmann::json read_report(const std::filesystem::path& file);

/// What each helmet left in the folder.
[[nodiscard]] std::vector<HelmetOutcome> read_outcomes(const std::filesystem::path& folder,
                                                       const FleetPlan& fleet);

/// Writes `summary` to summary.json in the folder.
[[nodiscard]] Result<void> write_summary(const std::filesystem::path& folder,
                                         const nlohmann::json& summary);

/// The pictures in the folder, the common map's first.
[[nodiscard]] std::vector<std::filesystem::path> pictures(const std::filesystem::path& folder);

/// The last line of a text file that is not empty; empty where there is none.
[[nodiscard]] std::string last_line(const std::filesystem::path& file);

}  // namespace lifeline::demo
