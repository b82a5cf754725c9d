#pragma once

#include <CLI/CLI.hpp>

namespace lifeline {

/// Parses a program's command line, whose subcommands' callbacks set `status`. Answers the
/// program's exit status: that of the subcommand, 0 for --help, 2 for wrong use (with one line that
/// says what is wrong).
[[nodiscard]] inline int parse_command_line(CLI::App& app, int argc, char** argv,
                                            const int& status) {
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    return failed->get_name() + ": " + error.what() + "; see --help\n";
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    return app.exit(end) == 0 ? 0 : 2;
  }
  return status;
}

}  // namespace lifeline
