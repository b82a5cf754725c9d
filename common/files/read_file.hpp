#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "common/base/result.hpp"

namespace lifeline::files {

/// The whole content of a file of at most `max_octets`. The size is looked at before anything is
/// allocated; a folder, a device or a file that cannot be read is an error.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& file,
                                            std::size_t max_octets);

}  // namespace lifeline::files
