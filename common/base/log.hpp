#pragma once

#include <string>
#include <string_view>

#include <spdlog/spdlog.h>

namespace lifeline {

/// Sends the default spdlog logger to stderr as `time level [name] text`, coloured only on a
/// terminal and without NO_COLOR. `level` is one of trace, debug, info, warn, error; anything else
/// means info.
void set_up_log(std::string_view name, std::string_view level);

/// While one lives, what its thread logs below `error` is left out of set_up_log()'s log: who plays
/// a mission again would say all of it again.
class QuietLog {
 public:
  QuietLog();
  ~QuietLog();
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;
};

}  // namespace lifeline
