#include "common/doctor/check_serial.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "agents/serial/serial_port.hpp"

namespace lifeline::doctor {
namespace {

namespace fs = std::filesystem;
const std::string kSerialCheck = "serial";
const std::string kJoinGroup =
    "add the user to group dialout (sudo usermod -aG dialout $USER) and log in again";

struct KnownAdapter {
  std::string_view usb_id, maker;
};
constexpr std::array<KnownAdapter, 6> kAdapters{{
    {"10c4:ea60", "Silicon Labs CP210x, as RPLIDARs have"},
    {"0403:6001", "FTDI FT232R, as attitude sensors have"},
    {"0403:6015", "FTDI FT230X, as attitude sensors have"},
    {"1a86:7523", "WCH CH340"},
    {"1a86:55d4", "WCH CH9102"},
    {"067b:2303", "Prolific PL2303"},
}};

std::string first_line(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

// The ids stand in the USB device's own folder, a few above the tty's.
std::optional<UsbSerial> describe(const fs::path& tty) {
  std::error_code problem;
  fs::path folder = fs::canonical(tty / "device", problem);
  for (int up = 0; !problem && up < 5 && folder.has_relative_path(); ++up) {
    const std::string vendor = first_line(folder / "idVendor");
    if (!vendor.empty()) {
      UsbSerial found{"/dev/" + tty.filename().string(),
                      vendor + ":" + first_line(folder / "idProduct"), ""};
      const auto known = std::ranges::find(kAdapters, found.usb_id, &KnownAdapter::usb_id);
      if (known != kAdapters.end()) found.maker = known->maker;
      return found;
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::string in_words(const UsbSerial& adapter) {
  return fmt::format("USB {} ({})", adapter.usb_id,
                     adapter.maker.empty() ? "not one that we know" : adapter.maker);
}

std::string what_is_there(const std::vector<UsbSerial>& adapters) {
  if (adapters.empty()) return "no USB serial adapter is plugged in";
  std::string text = "plugged in:";
  for (const UsbSerial& adapter : adapters)
    text += fmt::format(" {} {}", adapter.device, in_words(adapter));
  return text;
}

}  // namespace

std::vector<UsbSerial> list_usb_serial(const fs::path& root) {
  std::vector<UsbSerial> adapters;
  std::error_code problem;
  for (fs::directory_iterator entry(root / "sys/class/tty", problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (auto found = describe(entry->path())) adapters.push_back(*std::move(found));
  }
  std::ranges::sort(adapters, {}, &UsbSerial::device);
  return adapters;
}

Findings check_serial_port(const std::string& device, int baud, const fs::path& root) {
  const auto port = serial::SerialPort::open(device, baud);
  const std::vector<UsbSerial> adapters = list_usb_serial(root);
  if (!port) {
    Findings found = faults(kSerialCheck, device, port.error());
    if (port.error().code == ErrorCode::not_found)
      found.back().advice += "; " + what_is_there(adapters);
    return found;
  }
  std::error_code problem;
  const fs::path real = fs::canonical(device, problem);
  const auto adapter = std::ranges::find(adapters, real.string(), &UsbSerial::device);
  return {ok(kSerialCheck, device,
             fmt::format("opens at {} baud{}", baud,
                         adapter == adapters.end() ? "" : ", " + in_words(*adapter)))};
}

Findings check_plugged_in(const fs::path& root) {
  Findings found;
  for (const UsbSerial& adapter : list_usb_serial(root)) {
    const fs::path node = root / fs::path(adapter.device).relative_path();
    found.push_back(faccessat(AT_FDCWD, node.c_str(), R_OK | W_OK, AT_EACCESS) == 0
                        ? ok(kSerialCheck, adapter.device, in_words(adapter))
                        : fault(kSerialCheck, adapter.device,
                                in_words(adapter) + ", but this user may not open it", kJoinGroup));
  }
  return found;
}

}  // namespace lifeline::doctor
