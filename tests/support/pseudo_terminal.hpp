#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "agents/serial/file_descriptor.hpp"
#include "agents/serial/tty_settings.hpp"

namespace lifeline::test {

/// The far end of a serial line, made of a pseudo-terminal: what is written here is read from
/// device(), and the other way round. unplug() takes the device away, plug_in() gives a new one
/// (often with another name, as with USB adapters: `link` keeps one name for all of them).
class PseudoTerminal {
 public:
  /// `link` becomes a symbolic link to the device, as udev makes them; empty for none.
  explicit PseudoTerminal(std::string link = {}) : link_(std::move(link)) { plug_in(); }
  ~PseudoTerminal() { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  void plug_in() {
    if (is_plugged_in()) return;
    serial::FileDescriptor line(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    char name[128] = {};
    if (!line.is_open() || ::grantpt(line.get()) != 0 || ::unlockpt(line.get()) != 0 ||
        ::ptsname_r(line.get(), name, sizeof name) != 0) {
      std::abort();  // no pseudo-terminals here: nothing to test with
    }
    // Raw from the start: the line discipline must neither echo nor turn bytes into signals.
    if (serial::make_raw(line.get(), 9600) != 0) std::abort();
    line_ = std::move(line);
    name_ = name;
    if (link_.empty()) return;
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(name_, link_);
  }

  void unplug() {
    if (!link_.empty()) std::filesystem::remove(link_);
    line_.reset();
  }

  [[nodiscard]] bool is_plugged_in() const { return line_.is_open(); }
  [[nodiscard]] std::string device() const { return link_.empty() ? name_ : link_; }
  /// The rate that the other side has set.
  [[nodiscard]] int baud() const { return serial::actual_baud(line_.get()); }
  /// Sends what the line takes now; gives how much that was.
  std::size_t send(std::span<const std::uint8_t> bytes) {
    const ssize_t size = ::write(line_.get(), bytes.data(), bytes.size());
    return size > 0 ? static_cast<std::size_t>(size) : 0;
  }

  /// Waits up to `wait_ms` for bytes of the other side, and gives what there is.
  [[nodiscard]] std::vector<std::uint8_t> receive(int wait_ms) {
    pollfd watched{line_.get(), POLLIN, 0};
    std::vector<std::uint8_t> bytes;
    if (::poll(&watched, 1, wait_ms) <= 0) return bytes;
    bytes.resize(4096);
    const ssize_t size = ::read(line_.get(), bytes.data(), bytes.size());
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }

 private:
  std::string link_;
  std::string name_;
  serial::FileDescriptor line_;
};

}  // namespace lifeline::test
