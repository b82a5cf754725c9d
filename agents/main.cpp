#include <CLI/CLI.hpp>

#include "agents/run_command.hpp"
#include "agents/slam_command.hpp"
#include "common/base/command_line.hpp"

namespace lifeline {
namespace {

void add_attitude_option(CLI::App& command, std::string& attitude) {
  command.add_option(
      "--attitude", attitude,
      "Attitude sensor beside a live lidar, e.g. ahrs:/dev/ttyUSB1?kind=vectornav or "
      "kind=ahrs8 (docs/sources.md)");
}

void add_run_command(CLI::App& app, AgentRunOptions& options, int& status) {
  CLI::App* run = app.add_subcommand("run", "Map, and share the map, until stopped");
  run->add_option("--id", options.id, "This helmet's name, unique in the mission")->required();
  run->add_option("--source", options.source,
                  "Where scans come from, e.g. rplidar:/dev/ttyUSB0, sim:office or carmen:LOG.gz")
      ->required();
  add_attitude_option(*run, options.attitude);
  run->add_option("--config", options.config, "Configuration file (docs/parameters.md)");
  run->add_option("--report", options.report,
                  "Folder that takes map, trajectory and counters at the end");
  run->add_option("--mission", options.mission, "Mission name; overrides the configuration");
  run->add_option("--domain", options.domain, "DDS domain; overrides the configuration");
  run->add_option("--qos", options.qos, "QoS profile file; overrides the configuration");
  run->add_option("--matcher", options.matcher,
                  "conventional, advanced or direct; overrides the configuration");
  run->callback([&options, &status] { status = run_agent_command(options); });
}

void add_slam_command(CLI::App& app, SlamCommandOptions& options, int& status) {
  CLI::App* slam =
      app.add_subcommand("slam", "Map a source offline, as fast as it goes; Ctrl-C ends it early");
  slam->add_option("--source", options.source,
                   "Where scans come from, e.g. sim:office or carmen:LOG.gz?prior=odom")
      ->required();
  add_attitude_option(*slam, options.attitude);
  slam->add_option("--trajectory", options.trajectory,
                   "TUM file to write; NAME.truth.tum beside it where the source knows the truth");
  slam->add_option("--map", options.map, "Writes NAME.lifemap, NAME.pgm and NAME.yaml");
  slam->add_option("--stats", options.stats, "JSON file to write: counts, times, memory");
  slam->add_option("--config", options.config, "Configuration file (docs/parameters.md)");
  slam->add_option("--matcher", options.matcher,
                   "conventional, advanced or direct; overrides the configuration");
  slam->callback([&options, &status] { status = run_slam_command(options); });
}

}  // namespace
}  // namespace lifeline

int main(int argc, char** argv) {
  CLI::App app("Lifeline's helmet: maps a building from lidar scans and shares the map",
               "lifeline-agent");
  int status = 0;
  lifeline::AgentRunOptions run_options;
  lifeline::add_run_command(app, run_options, status);
  lifeline::SlamCommandOptions slam_options;
  lifeline::add_slam_command(app, slam_options, status);
  return lifeline::parse_command_line(app, argc, argv, status);
}
