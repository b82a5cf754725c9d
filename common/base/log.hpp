#pragma once

#include <string>
#include <string_view>

#include <spdlog/spdlog.h>

namespace lifeline {

/// Sends the default spdlog logger to stderr as `time level [name] text`, coloured only on a
/// terminal and without NO_COLOR. `level` is one of trace, debug, info, warn, error; anything else
/// means info.
void set_up_log(std::string_view name, std::string_view level);

}  // namespace lifeline
