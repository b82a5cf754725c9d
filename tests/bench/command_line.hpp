#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace lifeline::bench {

/// Parses what follows a benchmark's name. An exit status where the benchmark is not to run: 0 for
/// --help, 2 for wrong use.
[[nodiscard]] inline std::optional<int> parse_arguments(CLI::App& app,
                                                        std::span<const char* const> arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& end) {
    return app.exit(end) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace lifeline::bench
