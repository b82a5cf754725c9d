#include "common/cli/command_line.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "common/cli/completion.hpp"

namespace lifeline::cli {

std::optional<int> print_completion(const CLI::App& app, const std::string& program, int argc,
                                    const char* const* argv) {
  if (argc < 2 || std::string_view(argv[1]) != "completion") return std::nullopt;
  if (argc == 3) {
    if (const auto script = completion_for(argv[2], app, program)) {
      fmt::print("{}", *script);
      return 0;
    }
  }
  fmt::print(stderr, "{}: completion: give the shell: bash, zsh or fish\n", program);
  return 2;
}

int parse_command_line(CLI::App& app, int argc, char** argv, const int& status) {
  if (const auto printed = print_completion(app, app.get_name(), argc, argv)) return *printed;
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

}  // namespace lifeline::cli
