#include "deploy/demo/options.hpp"

#include <CLI/CLI.hpp>

#include "common/cli/command_line.hpp"
#include "common/cli/completion.hpp"
#include "deploy/demo/fleet_plan.hpp"

namespace lifeline::demo {

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app(
      "Helmets and a coordinator, each a process of its own, map a building together over DDS on "
      "this machine alone. Exits with 0 when all end up with the same common map.",
      "lifeline demo");
  app.add_option("--helmets", options.helmets, "How many helmets")
      ->check(CLI::Range(std::size_t{1}, kMostHelmets))
      ->capture_default_str();
  auto* plan = app.add_option("--plan", options.plan,
                              "Walk in this floor plan (HouseExpo .json), not in a made-up office")
                   ->type_name(cli::kFile);
  app.add_option("--log", options.log,
                 "Play this CARMEN log (.log, .log.gz), cut into as many pieces as helmets")
      ->type_name(cli::kFile)
      ->excludes(plan);
  app.add_option("--seed", options.seed, "Seed of the made-up office, the walks and the noise")
      ->capture_default_str();
  app.add_option("--report", options.report, "Folder for pictures and summary.json")
      ->type_name(cli::kFolder)
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit_s,
                 "Give up after so many seconds (default: what the scans take and a minute)")
      ->check(CLI::Range(1.0, 86400.0));
  if (const auto printed = cli::print_completion(app, "lifeline-demo", argc, argv)) return *printed;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  return options;
}

}  // namespace lifeline::demo
