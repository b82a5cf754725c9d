#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>

namespace lifeline::demo {

struct Options {
  std::size_t helmets = 3;
  std::string plan;  ///< a floor plan to walk in; empty = a generated office
  std::string log;   ///< a recorded log to cut into pieces instead of walking
  std::uint64_t seed = 1;
  std::filesystem::path report = "demo-report";
  double time_limit_s = 0.0;  ///< 0 = what the sources take and a minute
};

/// The options, or the exit status of a command line that asks for help or makes no sense, after
/// telling the user.
[[nodiscard]] std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace lifeline::demo
