#pragma once

#include <filesystem>

#include "common/base/result.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/settlement.hpp"

namespace lifeline {

/// Writes what the coordinator knows at the end: `coordinator.json`, `common_map.png` with each
/// helmet's path, `common_map.pgm` + `.yaml`, and `ID.png` for each helmet's own map before
/// merging.
[[nodiscard]] Result<void> write_report(const std::filesystem::path& folder,
                                        const Coordinator& coordinator, Settlement outcome);

}  // namespace lifeline
