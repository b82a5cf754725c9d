#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>

#include "agents/serial/file_descriptor.hpp"
#include "agents/serial/stop_event.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::serial {

/// A serial device as a stream of bytes: 8 data bits, no parity, 1 stop bit, no flow control.
///
/// One thread uses it. Nothing blocks beyond its deadline, and a stop request ends every wait at
/// once. Decoders should take bytes and the time at which they came, not a port: then bytes alone
/// test them.
class SerialPort {
 public:
  /// Opens `device` (e.g. /dev/ttyUSB0) for this process alone, at `baud` bits per second: any rate
  /// the device can make, not only the classic ones. What came in before is thrown away.
  ///
  /// not_found where there is no such device, wrong_use where it is no serial device, unavailable
  /// where it is not ours to open, in use, or cannot run at that rate; the text says what to do.
  [[nodiscard]] static Result<SerialPort> open(const std::string& device, int baud,
                                               const std::stop_token& stop = {});

  /// Waits until there are bytes, and reads what there is, at most `into`. Gives how many: 0 where
  /// `deadline` passed or a stop was requested first. Bytes that are there are read whatever the
  /// deadline. unavailable where the device is gone; the port is then of no more use.
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, SteadyTime deadline);

  /// Hands all of `bytes` to the system. unavailable where the device is gone, takes no more bytes
  /// until `deadline`, or a stop was requested first.
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes, SteadyTime deadline);

  /// Sets (true) or clears the line "data terminal ready". Devices without it pass over it.
  void set_dtr(bool on);

  /// Throws away what came in and was not read.
  void discard_input();

  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] bool stop_requested() const { return stop_->requested(); }

 private:
  enum class Wake { ready, time_is_up, gone };

  SerialPort(std::string device, FileDescriptor descriptor, const std::stop_token& stop);

  [[nodiscard]] Wake wait_for(short events, SteadyTime deadline) const;
  [[nodiscard]] tl::unexpected<Error> unplugged() const;

  std::string device_;
  FileDescriptor descriptor_;
  std::unique_ptr<StopEvent> stop_;  // behind a pointer: a stop callback cannot move
};

}  // namespace lifeline::serial
