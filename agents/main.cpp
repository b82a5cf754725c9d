#include <CLI/CLI.hpp>

#include "agents/doctor_command.hpp"
#include "agents/run_command.hpp"
#include "agents/slam_command.hpp"
#include "common/cli/command_line.hpp"
#include "common/cli/completion.hpp"
#include "common/cli/doctor_options.hpp"

namespace lifeline {
namespace {

void add_attitude_option(CLI::App& command, std::string& attitude) {
  command
      .add_option("--attitude", attitude,
                  "Attitude sensor beside an rplidar, e.g. ahrs:/dev/ttyUSB1?kind=vectornav or "
                  "kind=ahrs8 (docs/sources.md)")
      ->type_name("SOURCE");
}

void add_hud_options(CLI::App& command, hud::HudOptions& options) {
  command.add_flag("--hud", options.display,
                   "Show the wearer map, team-mates and way out on this machine's display");
  command
      .add_option_function<std::string>(
          "--hud-size",
          [&options](const std::string& text) {
            auto size = hud::parse_size(text);
            if (!size) throw CLI::ValidationError("--hud-size", size.error().text);
            options.size = *size;
          },
          "In a window of WxH pixels instead of the full screen")
      ->type_name("WxH");
  command
      .add_option("--hud-png", options.png,
                  "File that is given the HUD's picture each second, with or without a display")
      ->type_name(cli::kFile);
  command.add_option("--hud-key", options.key, "The keyboard key that is the button")
      ->capture_default_str();
  command.add_option("--button", options.button,
                     "FIFO or device to read the button from: 1 when it goes down, 0 when it comes "
                     "up (docs/hud.md)");
}

void add_run_command(CLI::App& app, AgentRunOptions& options, int& status) {
  CLI::App* run = app.add_subcommand("run", "Map, and share the map, until stopped");
  run->add_option("--id", options.id, "This helmet's name, unique in the mission")
      ->type_name("NAME")
      ->required();
  run->add_option(
         "--source", options.source,
         "Where scans come from, e.g. rplidar:/dev/ttyUSB0, ros2:/scan,/imu/data, sim:office or "
         "carmen:LOG.gz (docs/sources.md)")
      ->type_name("SOURCE")
      ->required();
  add_attitude_option(*run, options.attitude);
  run->add_option("--config", options.config, "Configuration file (docs/parameters.md)")
      ->type_name(cli::kFile);
  run->add_option("--report", options.report,
                  "Folder that takes map, trajectory and counters at the end")
      ->type_name(cli::kFolder);
  run->add_option("--state", options.state,
                  "Folder that keeps this helmet's state, so that it goes on after a restart; "
                  "overrides the configuration")
      ->type_name(cli::kFolder);
  run->add_option("--record", options.record,
                  "Folder that takes a new recording (rosbag2) of what this helmet hears and says; "
                  "overrides the configuration")
      ->type_name(cli::kFolder);
  run->add_option("--journal", options.journal,
                  "File that takes a line for each tile published and each that came into the "
                  "common map, with its time")
      ->type_name(cli::kFile);
  run->add_option("--mission", options.mission, "Mission name; overrides the configuration")
      ->type_name("NAME");
  run->add_option("--domain", options.domain, "DDS domain; overrides the configuration")
      ->type_name("NUMBER");
  run->add_option("--qos", options.qos, "QoS profile file; overrides the configuration")
      ->type_name(cli::kFile);
  run->add_option("--budget", options.budget_bit_s,
                  "Most that it sends, in bit/s; overrides the configuration")
      ->type_name("BIT/S")
      ->check(CLI::Range(8000, 1'000'000'000));
  run->add_option("--matcher", options.matcher,
                  "conventional, advanced or direct; overrides the configuration")
      ->type_name("conventional|advanced|direct");
  add_hud_options(*run, options.hud);
  run->callback([&options, &status] { status = run_agent_command(options); });
}

void add_slam_command(CLI::App& app, SlamCommandOptions& options, int& status) {
  CLI::App* slam =
      app.add_subcommand("slam", "Map a source offline, as fast as it goes; Ctrl-C ends it early");
  slam->add_option("--source", options.source,
                   "Where scans come from, e.g. sim:office or carmen:LOG.gz?prior=odom")
      ->type_name("SOURCE")
      ->required();
  add_attitude_option(*slam, options.attitude);
  slam->add_option("--trajectory", options.trajectory,
                   "TUM file to write; NAME.truth.tum beside it where the source knows the truth")
      ->type_name(cli::kFile);
  slam->add_option("--map", options.map, "Writes NAME.lifemap, NAME.pgm and NAME.yaml")
      ->type_name("NAME");
  slam->add_option("--stats", options.stats, "JSON file to write: counts, times, memory")
      ->type_name(cli::kFile);
  slam->add_option("--config", options.config, "Configuration file (docs/parameters.md)")
      ->type_name(cli::kFile);
  slam->add_option("--matcher", options.matcher,
                   "conventional, advanced or direct; overrides the configuration")
      ->type_name("conventional|advanced|direct");
  slam->add_flag("--json", options.json, "Print the figures of --stats instead of a line");
  slam->callback([&options, &status] { status = run_slam_command(options); });
}

void add_doctor_command(CLI::App& app, AgentDoctorOptions& options, int& status) {
  CLI::App* doctor = app.add_subcommand(
      "doctor", "Say whether a helmet could be run here, and what is in the way");
  doctor
      ->add_option("--source", options.source,
                   "The source that run would get: its serial device is opened for a moment; "
                   "without it, adapters that are plugged in are listed")
      ->type_name("SOURCE");
  add_attitude_option(*doctor, options.attitude);
  doctor
      ->add_option("--record", options.record, "Folder of recordings; overrides the configuration")
      ->type_name(cli::kFolder);
  cli::add_doctor_options(*doctor, options);
  doctor->callback([&options, &status] { status = run_agent_doctor_command(options); });
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
  lifeline::AgentDoctorOptions doctor_options;
  lifeline::add_doctor_command(app, doctor_options, status);
  return lifeline::cli::parse_command_line(app, argc, argv, status);
}
