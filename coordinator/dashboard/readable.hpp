#pragma once

#include <string>

namespace lifeline::dashboard {

/// Text from outside as Protobuf may carry it, which is UTF-8: other text keeps its printable ASCII
/// characters, and has '?' for the rest.
[[nodiscard]] std::string readable(const std::string& text);

}  // namespace lifeline::dashboard
