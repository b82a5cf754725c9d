#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/base/result.hpp"
#include "common/store/sqlite_handle.hpp"

namespace lifeline::store {

/// Why a file of records cannot be used. What to do about it differs.
enum class FileProblem {
  in_use,   ///< another process has it open
  damaged,  ///< it can be read, but is not what was written
  refused,  ///< the disk or the operating system refuses: full, read-only, broken
};

struct FileFailure {
  FileProblem problem;
  std::string text;  ///< one line: the file, the reason, what to do
};

template <typename T>
using FileResult = tl::expected<T, FileFailure>;

using Records = std::map<std::string, std::string>;

/// A record to write; without a value: to take away.
struct RecordChange {
  std::string key;
  std::optional<std::string> value;
};

/// Records by name in one file that survives the end of its process, and of the machine's power, at
/// any moment: an SQLite database with a write-ahead log, synchronised at each commit. Whatever
/// was not wholly committed is not there; each record carries a check sum over key and value, since
/// SQLite notices torn pages, but not a bit that fell over. A lock beside it (FILE.lock) is freed
/// by the system however the process ends. One owner, not thread-safe.
class RecordFile {
 public:
  static constexpr std::size_t kMaxValue = std::size_t{1} << 20;
  static constexpr std::size_t kMaxRecords = 200'000;
  static constexpr std::size_t kMaxOctets = std::size_t{512} << 20;

  /// Opens or makes `file`; its folder is made where it is missing.
  [[nodiscard]] static FileResult<RecordFile> open(const std::filesystem::path& file);

  RecordFile(RecordFile&& other) noexcept;
  RecordFile& operator=(RecordFile&& other) noexcept;
  ~RecordFile();

  /// All records. Checks every sum.
  [[nodiscard]] FileResult<Records> read_all() const;

  /// All changes or none; on disk when it returns. After a failure the file is as before, and may
  /// be tried again.
  [[nodiscard]] FileResult<void> write(const std::vector<RecordChange>& changes);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  RecordFile(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  [[nodiscard]] FileResult<void> open_database();
  [[nodiscard]] FileResult<void> set_up();
  [[nodiscard]] FileResult<void> check_schema();
  [[nodiscard]] FileResult<void> execute(const char* sql) const;
  [[nodiscard]] FileResult<void> apply(const RecordChange& change);
  [[nodiscard]] FileResult<Statement> prepare(const char* sql) const;
  [[nodiscard]] FileResult<std::string> ask(const char* sql) const;
  [[nodiscard]] tl::unexpected<FileFailure> failure() const;

  std::filesystem::path path_;
  int lock_ = -1;
  Database database_;
  Statement put_, erase_;  ///< declared last: finalised before the database closes
};

}  // namespace lifeline::store
