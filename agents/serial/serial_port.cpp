#include "agents/serial/serial_port.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "agents/serial/tty_settings.hpp"
#include "common/base/check.hpp"

namespace lifeline::serial {
namespace {

/// A UART samples the middle of the tenth bit: 5 % off is where it begins to read the wrong one.
constexpr double kBaudTolerance = 0.02;

tl::unexpected<Error> refused(const std::string& device, int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return fail(ErrorCode::not_found,
                  "{}: no such device; plug it in, and look for its name in /dev/serial/by-id",
                  device);
    case EACCES:
    case EPERM:
      return fail(ErrorCode::unavailable,
                  "{}: permission denied; add the user to group dialout (sudo usermod -aG dialout "
                  "$USER) and log in again",
                  device);
    case EBUSY:
    case EWOULDBLOCK:
      return fail(ErrorCode::unavailable,
                  "{}: in use by another program; stop it (sudo fuser {} shows which)", device,
                  device);
    default:
      return fail(ErrorCode::unavailable, "{}: {}", device, std::generic_category().message(error));
  }
}

}  // namespace

SerialPort::SerialPort(std::string device, FileDescriptor descriptor, const std::stop_token& stop)
    : device_(std::move(device)),
      descriptor_(std::move(descriptor)),
      stop_(std::make_unique<StopEvent>(stop)) {}

Result<SerialPort> SerialPort::open(const std::string& device, int baud,
                                    const std::stop_token& stop) {
  LIFELINE_CHECK(baud > 0);
  // Non-blocking also because opening may wait for a modem's carrier.
  FileDescriptor descriptor(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!descriptor.is_open() && errno == EISDIR) {
    return fail(ErrorCode::wrong_use, "{}: a folder, not a serial device", device);
  }
  if (!descriptor.is_open()) return refused(device, errno);
  const int port = descriptor.get();
  if (::isatty(port) == 0) {
    return fail(ErrorCode::wrong_use, "{}: not a serial device", device);
  }
  // The lock keeps a second helmet out also where it runs as root, whom TIOCEXCL does not stop.
  if (::flock(port, LOCK_EX | LOCK_NB) != 0) return refused(device, errno);
  (void)::ioctl(port, TIOCEXCL);
  if (const int error = make_raw(port, baud); error != 0) return refused(device, error);
  if (const int made = actual_baud(port); std::abs(made - baud) > kBaudTolerance * baud) {
    return fail(ErrorCode::unavailable,
                "{}: cannot run at {} baud (the nearest it makes is {}); use the sensor's own "
                "adapter",
                device, baud, made);
  }
  ask_for_low_latency(port);
  serial::discard_input(port);
  return SerialPort(device, std::move(descriptor), stop);
}

Result<std::size_t> SerialPort::read(std::span<std::uint8_t> into, SteadyTime deadline) {
  LIFELINE_CHECK(!into.empty());
  for (;;) {
    const Wake wake = wait_for(POLLIN, deadline);
    if (wake == Wake::time_is_up) return 0;
    // A device that went away may have left bytes behind: they come first.
    const ssize_t size = ::read(descriptor_.get(), into.data(), into.size());
    if (size > 0) return static_cast<std::size_t>(size);
    const bool nothing_yet = size < 0 && (errno == EAGAIN || errno == EINTR);
    if (!nothing_yet || wake == Wake::gone) return unplugged();
  }
}

Result<void> SerialPort::write(std::span<const std::uint8_t> bytes, SteadyTime deadline) {
  while (!bytes.empty()) {
    const ssize_t size = ::write(descriptor_.get(), bytes.data(), bytes.size());
    if (size > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(size));
      continue;
    }
    if (size < 0 && errno != EAGAIN && errno != EINTR) return unplugged();
    const Wake wake = wait_for(POLLOUT, deadline);
    if (wake == Wake::gone) return unplugged();
    if (wake == Wake::time_is_up) {
      return fail(ErrorCode::unavailable, "{}: takes no more bytes; plug it out and in again",
                  device_);
    }
  }
  return {};
}

void SerialPort::set_dtr(bool on) {
  const int line = TIOCM_DTR;
  (void)::ioctl(descriptor_.get(), on ? TIOCMBIS : TIOCMBIC, &line);
}

void SerialPort::discard_input() {
  serial::discard_input(descriptor_.get());
}

SerialPort::Wake SerialPort::wait_for(short events, SteadyTime deadline) const {
  for (;;) {
    std::array<pollfd, 2> watched{
        {{descriptor_.get(), events, 0}, {stop_->descriptor(), POLLIN, 0}}};
    const Duration left = deadline - std::chrono::steady_clock::now();
    // Rounded up: a wait that ends early would go round again and again.
    const auto left_ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    const int ready = ::poll(watched.data(), watched.size(),
                             static_cast<int>(std::clamp<decltype(left_ms)>(left_ms, 0, 60'000)));
    if ((watched[0].revents & events) != 0) return Wake::ready;
    if ((watched[0].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return Wake::gone;
    if (stop_->requested()) return Wake::time_is_up;
    if (ready <= 0 && std::chrono::steady_clock::now() >= deadline) return Wake::time_is_up;
  }
}

tl::unexpected<Error> SerialPort::unplugged() const {
  return fail(ErrorCode::unavailable, "{}: unplugged; check the plug and the cable", device_);
}

}  // namespace lifeline::serial
