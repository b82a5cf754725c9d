#include <CLI/CLI.hpp>

#include "common/base/command_line.hpp"
#include "coordinator/match_command.hpp"
#include "coordinator/run_command.hpp"

namespace lifeline {
namespace {

void add_run_command(CLI::App& app, CoordinatorRunOptions& options, int& status) {
  CLI::App* run = app.add_subcommand("run", "Decide which helmets' maps are merged, until stopped");
  run->add_option("--id", options.id, "This coordinator's name")->capture_default_str();
  run->add_option("--config", options.config, "Configuration file (docs/parameters.md)");
  run->add_option("--report", options.report,
                  "Folder that takes maps, pictures and figures at the end");
  run->add_option("--mission", options.mission, "Mission name; overrides the configuration");
  run->add_option("--domain", options.domain, "DDS domain; overrides the configuration");
  run->add_option("--qos", options.qos, "QoS profile file; overrides the configuration");
  run->add_option("--expect", options.expect, "How many helmets --until-settled waits for");
  run->add_flag("--until-settled", options.until_settled,
                "End once all helmets finished and hold the same map");
  run->add_option("--time-limit", options.time_limit_s, "End after this many seconds")
      ->check(CLI::PositiveNumber);
  run->callback([&options, &status] { status = run_coordinator_command(options); });
}

void add_match_command(CLI::App& app, MatchCommandOptions& options, int& status) {
  CLI::App* match = app.add_subcommand("match", "Find how two saved maps fit together");
  match->add_option("a", options.a, "First map: NAME.yaml (ROS map_server) or NAME.lifemap")
      ->required();
  match->add_option("b", options.b, "Second map")->required();
  match->add_flag("--json", options.json, "Print one JSON object");
  match->add_option("--matching", options.matching, "oriented, or spectra (the paper's path)")
      ->capture_default_str();
  match->add_option("--picture", options.picture,
                    "PNG file to write: the second map laid on the first");
  match->callback([&options, &status] { status = run_match_command(options); });
}

}  // namespace
}  // namespace lifeline

int main(int argc, char** argv) {
  CLI::App app("Lifeline's command vehicle: merges the helmets' maps", "lifeline-coordinator");
  int status = 0;
  lifeline::CoordinatorRunOptions run_options;
  lifeline::add_run_command(app, run_options, status);
  lifeline::MatchCommandOptions match_options;
  lifeline::add_match_command(app, match_options, status);
  return lifeline::parse_command_line(app, argc, argv, status);
}
