#pragma once

#include <filesystem>

#include "common/base/result.hpp"

namespace lifeline {

/// Where the shipped configuration stands: $LIFELINE_CONFIG, else `config` two or three folders
/// above the program (a build tree), else /etc/lifeline.
[[nodiscard]] Result<std::filesystem::path> config_folder();

}  // namespace lifeline
