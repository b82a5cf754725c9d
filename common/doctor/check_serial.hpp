#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// A serial adapter that is plugged in.
struct UsbSerial {
  std::string device;  ///< "/dev/ttyUSB0"
  std::string usb_id;  ///< "10c4:ea60"
  std::string maker;   ///< what such an id usually is; empty: not known
};

/// Those that the kernel names (sys/class/tty below `root`), in the order of their names.
[[nodiscard]] std::vector<UsbSerial> list_usb_serial(const std::filesystem::path& root);

/// Whether `device` is there, is a serial device, is ours to open, is free, and runs at `baud`: it
/// is opened for that, as a helmet would. Names the adapter where it is a USB one.
[[nodiscard]] Findings check_serial_port(const std::string& device, int baud,
                                         const std::filesystem::path& root);

/// What is plugged in, where nothing was said of a sensor: its name, and whether this user may open
/// it.
[[nodiscard]] Findings check_plugged_in(const std::filesystem::path& root);

}  // namespace lifeline::doctor
