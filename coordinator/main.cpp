#include <CLI/CLI.hpp>

#include "common/cli/command_line.hpp"
#include "common/cli/completion.hpp"
#include "common/cli/doctor_options.hpp"
#include "coordinator/doctor_command.hpp"
#include "coordinator/export_command.hpp"
#include "coordinator/match_command.hpp"
#include "coordinator/replay_command.hpp"
#include "coordinator/run_command.hpp"
#include "coordinator/watch_command.hpp"

namespace lifeline {
namespace {

/// What every command that joins a mission takes.
template <typename Options>
void add_mission_options(CLI::App& command, Options& options) {
  command.add_option("--config", options.config, "Configuration file (docs/parameters.md)")
      ->type_name(cli::kFile);
  command.add_option("--mission", options.mission, "Mission name; overrides the configuration")
      ->type_name("NAME");
  command.add_option("--domain", options.domain, "DDS domain; overrides the configuration")
      ->type_name("NUMBER");
  command.add_option("--qos", options.qos, "QoS profile file; overrides the configuration")
      ->type_name(cli::kFile);
  command.add_option("--time-limit", options.time_limit_s, "End after this many seconds")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
}

void add_run_command(CLI::App& app, CoordinatorRunOptions& options, int& status) {
  CLI::App* run = app.add_subcommand("run", "Decide which helmets' maps are merged, until stopped");
  run->add_option("--id", options.id,
                  "This coordinator's name; coordinator, or standby, where none is given")
      ->type_name("NAME");
  add_mission_options(*run, options);
  run->add_option("--report", options.report,
                  "Folder that takes maps, pictures and figures at the end")
      ->type_name(cli::kFolder);
  run->add_option("--state", options.state,
                  "Folder that keeps this coordinator's state, so that it goes on after a restart; "
                  "overrides the configuration")
      ->type_name(cli::kFolder);
  run->add_option("--record", options.record,
                  "Folder that takes a new recording (rosbag2) of all that is heard; overrides the "
                  "configuration")
      ->type_name(cli::kFolder);
  run->add_flag("--ros2-out", options.ros2_out,
                "Publish map, transforms, poses, paths and scans for ROS 2's tools");
  run->add_flag("--foxglove", options.foxglove,
                "Listen for Foxglove and Lichtblick, ws://127.0.0.1:8765 unless configured");
  run->add_option("--dashboard", options.dashboard,
                  "Where the page is served: ADDRESS:PORT, or off; 127.0.0.1:8642 where none is "
                  "given and that port is free")
      ->type_name("ADDRESS:PORT");
  run->add_flag("--standby", options.standby, "Lead only while no other coordinator does");
  run->add_option("--expect", options.expect, "How many helmets --until-settled waits for")
      ->type_name("NUMBER");
  run->add_flag("--until-settled", options.until_settled,
                "End once all helmets finished and hold the same map");
  run->callback([&options, &status] { status = run_coordinator_command(options); });
}

void add_match_command(CLI::App& app, MatchCommandOptions& options, int& status) {
  CLI::App* match = app.add_subcommand("match", "Find how two saved maps fit together");
  match->add_option("a", options.a, "First map: NAME.yaml (ROS map_server) or NAME.lifemap")
      ->required();
  match->add_option("b", options.b, "Second map")->required();
  match->add_flag("--json", options.json, "Print one JSON object");
  match->add_option("--matching", options.matching, "oriented, or spectra (the paper's path)")
      ->type_name("oriented|spectra")
      ->capture_default_str();
  match
      ->add_option("--picture", options.picture,
                   "PNG file to write: the second map laid on the first")
      ->type_name(cli::kFile);
  match->callback([&options, &status] { status = run_match_command(options); });
}

void add_replay_command(CLI::App& app, ReplayCommandOptions& options, int& status) {
  CLI::App* replay = app.add_subcommand(
      "replay", "Play a recording, and say which common map the mission came to");
  replay->add_option("bag", options.bag, "The recording's folder, or its .db3 file")->required();
  replay->add_option("--speed", options.speed, "How many times as fast as it was; max: at once")
      ->type_name("NUMBER")
      ->capture_default_str();
  replay->add_flag("--json", options.json, "Print one JSON object, at the end");
  replay
      ->add_option("--dashboard", options.dashboard,
                   "ADDRESS:PORT of a page that shows it, which stays until Ctrl-C")
      ->type_name("ADDRESS:PORT");
  replay->callback([&options, &status] { status = run_replay_command(options); });
}

void add_export_command(CLI::App& app, ExportCommandOptions& options, int& status) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a recording or a saved map in formats that other programs read");
  command->add_option("source", options.source, "A recording, NAME.lifemap, or NAME.yaml")
      ->required();
  command->add_option("--to", options.to, "Folder that takes the files")
      ->type_name(cli::kFolder)
      ->required();
  command
      ->add_option("--format", options.formats,
                   "Any of pgm png svg pdf tum csv geojson; all that can be made by default")
      ->type_name("FORMAT,...")
      ->delimiter(',');
  command
      ->add_option("--origin", options.origin,
                   "For geojson, twice: a point of the map and where it lies, X,Y=LATITUDE,"
                   "LONGITUDE (m, degrees)")
      ->type_name("X,Y=LAT,LON");
  command->add_flag("--json", options.json, "Print one JSON object: what was written");
  command->callback([&options, &status] { status = run_export_command(options); });
}

void add_watch_command(CLI::App& app, CoordinatorWatchOptions& options, int& status) {
  CLI::App* watch = app.add_subcommand("watch", "Show the fleet in a terminal; only listens");
  add_mission_options(*watch, options);
  watch->add_flag("--json", options.json, "A JSON line for each status and each pose");
  watch->callback([&options, &status] { status = run_watch_command(options); });
}

void add_doctor_command(CLI::App& app, CoordinatorDoctorOptions& options, int& status) {
  CLI::App* doctor = app.add_subcommand(
      "doctor", "Say whether a command vehicle could be run here, and what is in the way");
  doctor
      ->add_option("--record", options.record, "Folder of recordings; overrides the configuration")
      ->type_name(cli::kFolder);
  doctor
      ->add_option("--dashboard", options.dashboard,
                   "Where the page is to be served: ADDRESS:PORT, or off")
      ->type_name("ADDRESS:PORT");
  doctor->add_flag("--foxglove", options.foxglove, "Look at the port for Foxglove, too");
  cli::add_doctor_options(*doctor, options);
  doctor->callback([&options, &status] { status = run_coordinator_doctor_command(options); });
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
  lifeline::ReplayCommandOptions replay_options;
  lifeline::add_replay_command(app, replay_options, status);
  lifeline::ExportCommandOptions export_options;
  lifeline::add_export_command(app, export_options, status);
  lifeline::CoordinatorWatchOptions watch_options;
  lifeline::add_watch_command(app, watch_options, status);
  lifeline::CoordinatorDoctorOptions doctor_options;
  lifeline::add_doctor_command(app, doctor_options, status);
  return lifeline::cli::parse_command_line(app, argc, argv, status);
}
