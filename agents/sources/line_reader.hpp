#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::sources {

/// Reads a text file line by line, plain or gzip-compressed (told apart by content, not by name).
/// Holds one line at a time, of at most kMaxLineBytes, whatever the file unpacks to.
class LineReader {
 public:
  static constexpr std::size_t kMaxLineBytes = 256 * 1024;

  struct Line {
    std::string_view text;    ///< without its end of line; valid until the next call
    bool is_complete = true;  ///< false for a last line that the file leaves without a newline
  };

  /// not_found where there is no such file, unavailable where it cannot be read.
  [[nodiscard]] static Result<LineReader> open(const std::string& path);

  /// The next line, empty at the end. bad_data for a line that is too long, and for compressed data
  /// that is damaged or stops early.
  [[nodiscard]] Result<std::optional<Line>> next();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Of the line that next() gave last, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }

 private:
  struct CloseFile {
    void operator()(void* file) const;
  };
  LineReader(std::string path, void* file);
  [[nodiscard]] Result<bool> fill();

  std::string path_;
  std::unique_ptr<void, CloseFile> file_;  ///< zlib's gzFile
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  ///< of what is not handed out yet, in buffer_
  std::size_t end_ = 0;
  std::size_t line_number_ = 0;
};

}  // namespace lifeline::sources
