#include "common/files/atomic_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "common/base/check.hpp"

namespace lifeline::files {
namespace {

tl::unexpected<Error> refused(const std::filesystem::path& file, int error) {
  return fail(ErrorCode::unavailable, "{}: cannot be written ({}); choose a folder that can be",
              file.string(), std::generic_category().message(error));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file, std::string temporary, int handle)
    : file_(std::move(file)), temporary_(std::move(temporary)), handle_(handle) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::move(other.temporary_)),
      handle_(std::exchange(other.handle_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(temporary_, other.temporary_);
  std::swap(handle_, other.handle_);
  return *this;
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& file) {
  std::string temporary = file.string() + ".XXXXXX";
  const int handle = ::mkstemp(temporary.data());
  if (handle < 0) return refused(file, errno);
  return AtomicFile(file, std::move(temporary), handle);
}

Result<void> AtomicFile::append(std::string_view content) {
  LIFELINE_CHECK(handle_ >= 0);
  while (!content.empty()) {
    const ssize_t written = ::write(handle_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return give_up(errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> AtomicFile::commit() {
  LIFELINE_CHECK(handle_ >= 0);
  // mkstemp makes files that only their owner can read; reports are for everybody.
  if (::fsync(handle_) != 0 || ::fchmod(handle_, 0644) != 0) return give_up(errno);
  const int error = ::close(std::exchange(handle_, -1)) != 0 ? errno : 0;
  if (error == 0 && ::rename(temporary_.c_str(), file_.c_str()) == 0) return {};
  const int reason = error != 0 ? error : errno;
  ::unlink(temporary_.c_str());
  return refused(file_, reason);
}

Result<void> AtomicFile::give_up(int error) {
  discard();
  return refused(file_, error);
}

void AtomicFile::discard() {
  if (handle_ < 0) return;
  ::close(std::exchange(handle_, -1));
  ::unlink(temporary_.c_str());
}

Result<void> write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  auto written = AtomicFile::create(file);
  if (!written) return forward_error(written);
  if (auto appended = written->append(content); !appended) return appended;
  return written->commit();
}

}  // namespace lifeline::files
