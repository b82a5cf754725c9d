#pragma once

#include <string>
#include <string_view>

namespace lifeline::dashboard {

/// A zstd frame of these octets, as the page unpacks it.
[[nodiscard]] std::string to_zstd(std::string_view plain);

}  // namespace lifeline::dashboard
