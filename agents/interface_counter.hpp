#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "common/base/result.hpp"

namespace lifeline {

/// Counts what a network interface has sent since it came up, as the system does. not_found where
/// there is no interface of that name; one that vanishes later stands still.
[[nodiscard]] Result<std::function<std::uint64_t()>> interface_counter(const std::string& name);

}  // namespace lifeline
