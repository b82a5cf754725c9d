#pragma once

#include <filesystem>
#include <string>

#include "common/base/result.hpp"

namespace lifeline::store {

/// So many files are kept aside under one name; then the last of them is replaced.
inline constexpr int kMostAside = 9;

/// Gives a closed file of records another name, so that a new one can take its place: `FILE.WHY-N`
/// with the first free number N, its log beside it. The new name.
[[nodiscard]] Result<std::filesystem::path> put_aside(const std::filesystem::path& file,
                                                      const std::string& why);

}  // namespace lifeline::store
