#pragma once

#include <string>

#include "common/base/result.hpp"
#include "coordinator/export/mission_story.hpp"

namespace lifeline {

/// The mission on paper (A4): when it was, its map with everybody's paths, and tables of helmets,
/// finds, alerts and merges. A PDF file's content.
[[nodiscard]] Result<std::string> to_report_pdf(const MissionStory& story);

}  // namespace lifeline
