#pragma once

#include <string>
#include <vector>

namespace lifeline::dds {

/// From now on Fast DDS's errors go to spdlog's default logger, not to stdout. Repeats change
/// nothing.
void route_middleware_log();

/// While one of these lives, Fast DDS's errors are kept instead of being logged. One at a time:
/// callers hold profiles_mutex().
class LogCapture {
 public:
  LogCapture();
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  /// What Fast DDS complained about so far, oldest (and thus most specific) first.
  [[nodiscard]] std::vector<std::string> errors() const;
};

}  // namespace lifeline::dds
