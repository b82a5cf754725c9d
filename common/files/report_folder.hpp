#pragma once

#include <filesystem>

#include "common/base/result.hpp"

namespace lifeline::files {

/// Makes the folder and proves that a file can be written there, so that a run fails before it
/// begins and not at its end.
[[nodiscard]] Result<void> prepare_report_folder(const std::filesystem::path& folder);

}  // namespace lifeline::files
