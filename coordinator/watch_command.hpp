#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lifeline {

struct CoordinatorWatchOptions {
  std::optional<std::filesystem::path> config;
  std::optional<std::string> mission;
  std::optional<std::uint32_t> domain;
  std::optional<std::filesystem::path> qos;
  bool json = false;
  std::optional<double> time_limit_s;
};

/// Shows the fleet in a terminal, once a second, until stopped: who is heard, how old, what each
/// holds and sends, and whether all hold the same map. It only listens: nobody needs it and it
/// changes nothing. With `json` one line for each status and each pose as it comes in, for
/// programs. Exit status 0, 1 when the network or its settings fail, 2 for wrong use.
[[nodiscard]] int run_watch_command(const CoordinatorWatchOptions& options);

}  // namespace lifeline
