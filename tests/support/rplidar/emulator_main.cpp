// An RPLIDAR to try things with: lifeline-rplidar-emulator --link /tmp/lidar, and, in another
// window, lifeline-agent slam --source rplidar:/tmp/lidar.

#include <csignal>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

#include "common/base/stop_signal.hpp"
#include "tests/support/rplidar/emulator.hpp"

namespace lifeline::test {
namespace {

constexpr const char* kHelp =
    "silent | talk | stall | turn | unplug | plug | noise LOST FLIPPED INSERTED | health STATUS "
    "CODE | heal | quit";

/// Does what one line says; false where it is to end.
bool obey(RplidarEmulator& lidar, const std::string& line) {
  std::istringstream words(line);
  std::string word;
  words >> word;
  if (word == "quit") return false;
  if (word == "silent" || word == "talk") {
    lidar.set_silent(word == "silent");
  } else if (word == "stall" || word == "turn") {
    lidar.set_stalled(word == "stall");
  } else if (word == "unplug") {
    lidar.unplug();
  } else if (word == "plug") {
    lidar.plug_in();
  } else if (word == "noise") {
    NoiseRates rates;
    words >> rates.lost >> rates.flipped >> rates.inserted;
    lidar.set_noise(rates);
  } else if (word == "health") {
    unsigned status = 0, code = 0;
    words >> status >> code;
    lidar.set_health(static_cast<std::uint8_t>(status), static_cast<std::uint16_t>(code));
  } else if (word == "heal") {
    lidar.heal_at_reset();
  } else {
    std::puts(kHelp);
  }
  return true;
}

int emulate(const EmulatorOptions& options, const std::string& link) {
  watch_stop_signals();
  RplidarEmulator lidar(options, link);
  std::printf("%s\n%s\n", lidar.device().c_str(), kHelp);
  std::fflush(stdout);
  std::string line;
  while (std::getline(std::cin, line) && obey(lidar, line)) {
  }
  // Without anybody who types, it runs until it is stopped.
  while (line != "quit" && !stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return 0;
}

}  // namespace
}  // namespace lifeline::test

int main(int argc, char** argv) {
  CLI::App app("An emulated RPLIDAR A3 in a room of 6 by 4 m, on a pseudo-terminal",
               "lifeline-rplidar-emulator");
  lifeline::test::EmulatorOptions options;
  std::string link;
  bool fast = false;
  app.add_option("--link", link, "Name of the device that stays when it is plugged in again");
  app.add_option("--baud", options.baud, "Rate at which it can be understood");
  app.add_option("--rotor", options.rotor_Hz, "Turns a second");
  app.add_flag("--fast", fast, "As fast as the other side reads");
  CLI11_PARSE(app, argc, argv);
  options.real_time = !fast;
  return lifeline::test::emulate(options, link);
}
