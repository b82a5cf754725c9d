#include "common/store/file_lock.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace lifeline::store {
namespace {

std::string holder_of(int handle) {
  std::array<char, 16> text{};
  const ssize_t read = ::pread(handle, text.data(), text.size(), 0);
  std::string pid;
  for (ssize_t i = 0; i < read && text[static_cast<std::size_t>(i)] >= '0' &&
                      text[static_cast<std::size_t>(i)] <= '9';
       ++i) {
    pid += text[static_cast<std::size_t>(i)];
  }
  return pid.empty() ? "another process" : "process " + pid;
}

}  // namespace

tl::expected<int, LockRefusal> take_lock(const std::filesystem::path& file) {
  const std::string name = file.string() + ".lock";
  const int handle = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (handle < 0) {
    return tl::unexpected(LockRefusal{false, std::generic_category().message(errno)});
  }
  if (::flock(handle, LOCK_EX | LOCK_NB) != 0) {
    LockRefusal refusal{errno == EWOULDBLOCK, std::generic_category().message(errno)};
    if (refusal.held) refusal.reason = holder_of(handle);
    ::close(handle);
    return tl::unexpected(std::move(refusal));
  }
  // For people only: on a full disk the lock holds all the same.
  const std::string pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(handle, 0) == 0) {
    [[maybe_unused]] const ssize_t written = ::pwrite(handle, pid.data(), pid.size(), 0);
  }
  return handle;
}

}  // namespace lifeline::store
