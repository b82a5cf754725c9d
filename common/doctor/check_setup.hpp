#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/doctor/check_disk.hpp"
#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// What a program would be started with, as far as the machine must bear it.
struct Setup {
  struct Folder {
    std::string check;    ///< "state", "recording"
    std::string path;     ///< "off": nothing is kept there
    std::string setting;  ///< what to change
    DiskNeed need;
  };
  struct SerialDevice {
    std::string device;
    int baud = 0;
  };
  struct TcpPort {
    std::string check;  ///< "dashboard"
    std::string address;
    std::uint16_t port = 0;
    std::string advice;
    bool is_needed = true;  ///< the program does not start without it
  };

  std::optional<std::filesystem::path> config_file;
  std::optional<Error> config_error;  ///< why it cannot be read; defaults stand in for it
  Result<std::filesystem::path> qos_file = std::filesystem::path();
  std::uint32_t domain = 0;
  std::string counted_interface = "none";
  std::vector<Folder> folders;
  std::vector<TcpPort> tcp_ports;
  std::vector<SerialDevice> serial_devices;
  bool wants_sensors = false;  ///< without serial_devices, what is plugged in is listed
};

/// Looks at all of it, in the order in which a start would come to it. The machine's /proc, /sys
/// and /dev/shm are read below `root`; files, ports and devices that the setup names are the real
/// ones.
[[nodiscard]] Findings check_setup(const Setup& setup, const std::filesystem::path& root = "/");

/// Prints the findings to stdout, as text or JSON, and answers the program's exit status.
[[nodiscard]] int print_findings(const Findings& findings, bool json);

}  // namespace lifeline::doctor
