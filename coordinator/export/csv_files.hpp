#pragma once

#include <filesystem>

#include "common/base/result.hpp"
#include "coordinator/export/mission_story.hpp"

namespace lifeline {

/// Writes paths.csv, detections.csv, alerts.csv and merges.csv (RFC 4180, UTF-8, a heading line;
/// docs/recording.md names the columns). A cell that a table program would take for a formula gets
/// an apostrophe before it: texts come from the network.
[[nodiscard]] Result<void> write_csv_files(const std::filesystem::path& folder,
                                           const MissionStory& story);

}  // namespace lifeline
