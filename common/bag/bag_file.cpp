#include "common/bag/bag_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace lifeline::bag {
namespace {

constexpr std::size_t kMaxTopics = 10'000;
constexpr int kMaxValueBytes = 64 * 1024 * 1024;  // other topics may hold large images

using store::Database;
using store::Statement;

/// A path as an SQLite URI, which gives '%', '?' and '#' meanings of their own.
std::string uri(const std::string& file) {
  std::string text = "file:";
  for (const char c : file) {
    if (c == '%' || c == '?' || c == '#') {
      text += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  std::error_code ignored;
  const auto log_bytes = std::filesystem::file_size(file + "-wal", ignored);
  // Immutable: no lock and no file beside it. But then a write-ahead log would not be read.
  return text + (ignored || log_bytes == 0 ? "?mode=ro&immutable=1" : "?mode=ro");
}

tl::unexpected<Error> fail_reading(const std::string& file, sqlite3* database) {
  const int code = sqlite3_errcode(database) & 0xff;
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    return fail(ErrorCode::bad_data, "{}: is no rosbag2 file, or damaged or truncated ({})", file,
                sqlite3_errmsg(database));
  }
  if (code == SQLITE_BUSY) {
    return fail(ErrorCode::unavailable, "{}: is being recorded just now; stop that first", file);
  }
  return fail(code == SQLITE_ERROR ? ErrorCode::bad_data : ErrorCode::unavailable,
              "{}: cannot be read as a rosbag2 file: {}", file, sqlite3_errmsg(database));
}

/// When the file's first message was recorded.
Result<std::int64_t> first_time(const std::string& name) {
  const auto file = BagFile::open(name);
  if (!file) return forward_error(file);
  const auto query = file->prepare("SELECT min(timestamp) FROM messages");
  if (!query) return forward_error(query);
  if (const auto row = file->step(query->get()); !row) return forward_error(row);
  return sqlite3_column_int64(query->get(), 0);
}

}  // namespace

Result<BagFile> BagFile::open(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return fail(ErrorCode::not_found, "{}: no such file", file);
  }
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(uri(file).c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(opened);
  if (code != SQLITE_OK) return fail_reading(file, database.get());
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(database.get(), SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  BagFile bag(file, std::move(database));
  if (const auto checked = bag.check_tables(); !checked) return forward_error(checked);
  return bag;
}

Result<Statement> BagFile::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement,
                         nullptr) != SQLITE_OK) {
    return fail_reading(name_, database_.get());
  }
  return Statement(statement);
}

Result<bool> BagFile::step(sqlite3_stmt* statement) const {
  const int code = sqlite3_step(statement);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return fail_reading(name_, database_.get());
}

/// Real tables only: a view could compute anything, endlessly.
Result<void> BagFile::check_tables() const {
  const auto query = prepare(
      "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('topics', "
      "'messages')");
  if (!query) return forward_error(query);
  const auto row = step(query->get());
  if (!row) return forward_error(row);
  if (!*row || sqlite3_column_int(query->get(), 0) != 2) {
    return fail(ErrorCode::bad_data, "{}: is no rosbag2 file: it lacks the tables of one", name_);
  }
  return {};
}

std::string column_text(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? std::string() : std::string(text);
}

Result<std::vector<Topic>> topics_of(const BagFile& file) {
  const auto query =
      file.prepare("SELECT name, type, serialization_format FROM topics ORDER BY id");
  if (!query) return forward_error(query);
  std::vector<Topic> topics;
  for (;;) {
    const auto row = file.step(query->get());
    if (!row) return forward_error(row);
    if (!*row || topics.size() == kMaxTopics) return topics;
    topics.push_back({column_text(query->get(), 0), column_text(query->get(), 1)});
    if (const std::string format = column_text(query->get(), 2); format != "cdr") {
      return fail(ErrorCode::unsupported, "{}: topic {} is serialized as '{}', only cdr is known",
                  file.name(), topics.back().name, format);
    }
  }
}

Result<std::vector<std::string>> by_time(const std::vector<std::string>& files) {
  std::vector<std::pair<std::int64_t, std::string>> timed;
  for (const std::string& file : files) {
    const auto time = first_time(file);
    if (!time) return forward_error(time);
    timed.emplace_back(*time, file);
  }
  std::sort(timed.begin(), timed.end());
  std::vector<std::string> ordered;
  for (auto& [time, file] : timed) ordered.push_back(std::move(file));
  return ordered;
}

std::vector<std::string> files_ending(const std::string& folder, std::string_view ending) {
  std::vector<std::string> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().string().ends_with(ending)) files.push_back(entry->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace lifeline::bag
