#pragma once

#include <cstddef>
#include <filesystem>

#include "agents/helmet_mapper.hpp"

namespace lifeline {

/// Writes what a helmet knows at its end: `ID.json` (counters, times, hash of the common map),
/// `ID.tum`, `ID.truth.tum` where the source knows the truth, and `ID.lifemap`.
[[nodiscard]] Result<void> write_helmet_report(const std::filesystem::path& folder,
                                               const LayerKey& layer, const HelmetMapper& mapper,
                                               std::size_t scans_dropped,
                                               const sharing::HelmetSharing& helmet);

}  // namespace lifeline
