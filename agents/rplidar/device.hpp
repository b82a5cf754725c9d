#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "agents/rplidar/protocol.hpp"
#include "agents/serial/serial_port.hpp"

namespace lifeline::rplidar {

/// What to ask of the device.
struct DeviceSettings {
  std::string device;  ///< e.g. /dev/ttyUSB0
  int baud = 256'000;  ///< A3; A1 and most A2: 115,200
  std::uint16_t motor_pwm = 600;
  std::string mode;  ///< by name, in any case; empty: as choose_mode() says
};

/// What the device offers.
struct ScanModes {
  std::vector<ScanMode> all;
  std::optional<std::uint16_t> typical;  ///< the id of the one that its maker recommends
};

/// An RPLIDAR behind a serial port, ready to scan: it answers, is healthy and turns its rotor.
///
/// Every call ends within a second or two, or at once on a stop request. Errors name the device,
/// what is wrong, and what to check: power, cable, baud, rights. After an error the device is to be
/// opened anew. One thread uses it.
class Device {
 public:
  /// Opens the port and asks the device for its name, health and scan modes; a device that reports
  /// an error is reset and asked once more. The rotor is started. wrong_use for a mode that it has
  /// not, or that this build cannot decode.
  [[nodiscard]] static Result<std::unique_ptr<Device>> open(const DeviceSettings& settings,
                                                            const std::stop_token& stop);
  /// Stops scan and rotor, if the device is still there.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Begins to scan, and gives what came behind the answer.
  [[nodiscard]] Result<std::vector<std::uint8_t>> start_scan();
  /// As SerialPort::read().
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, SteadyTime deadline) {
    return port_.read(into, deadline);
  }

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const ScanMode& mode() const { return mode_; }
  [[nodiscard]] int baud() const { return settings_.baud; }

 private:
  Device(serial::SerialPort port, DeviceSettings settings)
      : port_(std::move(port)), settings_(std::move(settings)) {}

  [[nodiscard]] Result<void> greet();
  [[nodiscard]] Result<void> check_health();
  [[nodiscard]] Result<void> turn_rotor(std::uint16_t pwm);
  [[nodiscard]] Result<Health> ask_health();
  [[nodiscard]] Result<void> drain(Duration quiet);
  [[nodiscard]] Result<ScanModes> list_modes();
  [[nodiscard]] Result<ScanMode> ask_mode(std::uint16_t id);
  [[nodiscard]] Result<std::vector<std::uint8_t>> ask_conf(ConfEntry entry,
                                                           std::optional<std::uint16_t> mode);
  [[nodiscard]] Result<void> send(Command command, Bytes payload = {});
  [[nodiscard]] Result<AnswerFinder> ask(Command command, AnswerType type, Bytes payload = {});
  [[nodiscard]] Result<bool> wait_for(AnswerFinder& finder);
  [[nodiscard]] tl::unexpected<Error> no_answer(bool heard) const;

  serial::SerialPort port_;
  DeviceSettings settings_;
  DeviceInfo info_;
  ScanMode mode_;
  bool has_motor_control_ = false;
};

/// The mode to scan in: the one called `name`. Without a name the typical one, if its answers can
/// be decoded, or else the one with the most samples per second that can. wrong_use names the modes
/// that there are.
[[nodiscard]] Result<ScanMode> choose_mode(const ScanModes& modes, const std::string& name,
                                           const std::string& device);

}  // namespace lifeline::rplidar
