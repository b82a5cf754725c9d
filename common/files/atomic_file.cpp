#include "common/files/atomic_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace lifeline::files {
namespace {

tl::unexpected<Error> refused(const std::filesystem::path& file, int error) {
  return fail(ErrorCode::unavailable, "{}: cannot be written ({}); choose a folder that can be",
              file.string(), std::generic_category().message(error));
}

/// 0, or why it failed.
int write_all(int handle, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(handle, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(handle) == 0 ? 0 : errno;
}

}  // namespace

Result<void> write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  std::string temporary = file.string() + ".XXXXXX";
  const int handle = ::mkstemp(temporary.data());
  if (handle < 0) return refused(file, errno);
  int error = write_all(handle, content);
  // mkstemp makes files that only their owner can read; reports are for everybody.
  if (error == 0 && ::fchmod(handle, 0644) != 0) error = errno;
  if (::close(handle) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    return refused(file, error);
  }
  return {};
}

}  // namespace lifeline::files
