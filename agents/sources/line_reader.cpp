#include "agents/sources/line_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <zlib.h>

namespace lifeline::sources {
namespace {

constexpr std::size_t kReadBytes = 64 * 1024;

gzFile as_gz(void* file) {
  return static_cast<gzFile>(file);
}

}  // namespace

void LineReader::CloseFile::operator()(void* file) const {
  gzclose(as_gz(file));
}

LineReader::LineReader(std::string path, void* file) : path_(std::move(path)), file_(file) {}

Result<LineReader> LineReader::open(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return fail(ErrorCode::bad_data, "{}: is a folder, not a log", path);
  }
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    const int reason = errno;
    return fail(reason == ENOENT ? ErrorCode::not_found : ErrorCode::unavailable, "{}: {}", path,
                reason == ENOENT ? "no such file" : std::strerror(reason));
  }
  return LineReader(path, file);
}

Result<bool> LineReader::fill() {
  std::move(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= std::exchange(begin_, 0);
  buffer_.resize(end_ + kReadBytes);
  const int got = gzread(as_gz(file_.get()), buffer_.data() + end_, kReadBytes);
  int error = Z_OK;
  const char* reason = gzerror(as_gz(file_.get()), &error);
  if (error == Z_BUF_ERROR) {  // what was unpacked before the cut is of no use: say it at once
    return fail(ErrorCode::bad_data,
                "{}:{}: the compressed file ends early: it is truncated, fetch it again", path_,
                line_number_);
  }
  if (got < 0 || (error != Z_OK && error != Z_STREAM_END)) {
    return fail(ErrorCode::bad_data, "{}:{}: cannot be read: {}", path_, line_number_,
                error == Z_ERRNO ? std::strerror(errno) : reason);
  }
  end_ += static_cast<std::size_t>(got);
  return got > 0;
}

Result<std::optional<LineReader::Line>> LineReader::next() {
  std::size_t searched = 0;
  for (;;) {
    const char* from = buffer_.data() + begin_;
    const std::size_t held = end_ - begin_;
    const void* newline =
        held > searched ? std::memchr(from + searched, '\n', held - searched) : nullptr;
    if (newline != nullptr) {
      const auto length = static_cast<std::size_t>(static_cast<const char*>(newline) - from);
      begin_ += length + 1;
      ++line_number_;
      return Line{{from, length}, true};
    }
    if (held > kMaxLineBytes) {
      return fail(ErrorCode::bad_data, "{}:{}: a line of more than {} bytes: this is no text log",
                  path_, line_number_ + 1, kMaxLineBytes);
    }
    searched = held;
    const auto more = fill();
    if (!more) return forward_error(more);
    if (*more) continue;
    if (held == 0) return std::nullopt;
    begin_ = end_;
    ++line_number_;
    return Line{{buffer_.data() + end_ - held, held}, false};
  }
}

}  // namespace lifeline::sources
