#pragma once

#include <span>

#include "coordinator/dashboard/server.hpp"

namespace lifeline::dashboard {

/// The page's files, as they were built into the program (coordinator/dashboard/page).
[[nodiscard]] std::span<const Asset> page_assets();

}  // namespace lifeline::dashboard
