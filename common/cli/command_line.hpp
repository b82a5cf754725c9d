#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace lifeline::cli {

/// `PROGRAM completion SHELL` (bash, zsh, fish) prints the script that makes that shell complete
/// the program's command line. Then the answer is the exit status; nothing where something else was
/// asked for.
[[nodiscard]] std::optional<int> print_completion(const CLI::App& app, const std::string& program,
                                                  int argc, const char* const* argv);

/// Parses a program's command line, whose subcommands' callbacks set `status`. Answers the
/// program's exit status: that of the subcommand, 0 for --help, 2 for wrong use (with one line that
/// says what is wrong).
[[nodiscard]] int parse_command_line(CLI::App& app, int argc, char** argv, const int& status);

}  // namespace lifeline::cli
