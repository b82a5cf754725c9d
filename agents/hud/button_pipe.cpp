#include "agents/hud/button_pipe.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lifeline::hud {

Result<ButtonPipe> ButtonPipe::open(const std::filesystem::path& path) {
  // A FIFO that nobody writes to right now must not look as if it had ended.
  const bool is_fifo = std::filesystem::is_fifo(path);
  const int opened =
      ::open(path.c_str(), (is_fifo ? O_RDWR : O_RDONLY) | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (opened < 0) {
    return fail(errno == ENOENT ? ErrorCode::not_found : ErrorCode::unavailable,
                "--button {}: {}; give a FIFO (mkfifo) or a device that may be read", path.string(),
                std::strerror(errno));
  }
  return ButtonPipe(serial::FileDescriptor(opened));
}

std::vector<bool> ButtonPipe::take() {
  std::array<char, 64> octets{};
  const auto count = ::read(pipe_.get(), octets.data(), octets.size());
  std::vector<bool> presses;
  for (ssize_t i = 0; i < count; ++i) {
    const char octet = octets[static_cast<std::size_t>(i)];
    if (octet == '1' || octet == '0') presses.push_back(octet == '1');
  }
  return presses;
}

}  // namespace lifeline::hud
