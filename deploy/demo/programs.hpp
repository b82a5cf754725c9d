#pragma once

#include <filesystem>

#include "common/base/result.hpp"

namespace lifeline::demo {

/// What the demo starts, and the QoS profiles it starts them with.
struct Programs {
  std::filesystem::path agent;
  std::filesystem::path coordinator;
  std::filesystem::path qos;
};

/// The programs beside `self` (a program's path, links resolved) and the loopback profiles of the
/// configuration folder `config`. not_found names what is missing.
[[nodiscard]] Result<Programs> find_programs(const std::filesystem::path& self,
                                             const std::filesystem::path& config);

}  // namespace lifeline::demo
