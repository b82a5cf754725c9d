#pragma once

#include <filesystem>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline::files {

/// Writes a file so that whoever reads it, even after a crash, finds the old content or the new one
/// and never a part: to a neighbouring temporary file, flushed to the disk, then renamed. The
/// folder must exist. On failure nothing is left behind.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& file,
                                                 std::string_view content);

}  // namespace lifeline::files
