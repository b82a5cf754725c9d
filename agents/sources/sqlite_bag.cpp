#include "agents/sources/sqlite_bag.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include <sqlite3.h>

namespace lifeline::sources {
namespace {

constexpr std::size_t kMaxTopics = 10'000;
constexpr int kMaxValueBytes = 64 * 1024 * 1024;  // other topics may hold large images

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

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
  return fail(code == SQLITE_ERROR ? ErrorCode::bad_data : ErrorCode::unavailable,
              "{}: cannot be read as a rosbag2 file: {}", file, sqlite3_errmsg(database));
}

Result<Statement> prepare(const std::string& file, sqlite3* database, std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr) !=
      SQLITE_OK) {
    return fail_reading(file, database);
  }
  return Statement(statement);
}

std::string column_text(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? std::string() : std::string(text);
}

/// True on a row, false at the end.
Result<bool> step(const std::string& file, sqlite3* database, sqlite3_stmt* statement) {
  const int code = sqlite3_step(statement);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return fail_reading(file, database);
}

/// Real tables only: a view could compute anything, endlessly.
Result<void> check_tables(const std::string& file, sqlite3* database) {
  const auto query = prepare(file, database,
                             "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN "
                             "('topics', 'messages')");
  if (!query) return forward_error(query);
  const auto row = step(file, database, query->get());
  if (!row) return forward_error(row);
  if (!*row || sqlite3_column_int(query->get(), 0) != 2) {
    return fail(ErrorCode::bad_data, "{}: is no rosbag2 file: it lacks the tables of one", file);
  }
  return {};
}

Result<Database> open_database(const std::string& file) {
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
  if (const auto checked = check_tables(file, database.get()); !checked) {
    return forward_error(checked);
  }
  return database;
}

/// Plays one topic through one file after the other.
class SqliteTopic {
 public:
  SqliteTopic(std::vector<std::string> files, std::string topic)
      : files_(std::move(files)), topic_(std::move(topic)) {}

  Result<std::optional<BagMessage>> next() {
    for (;;) {
      if (!query_) {
        if (next_file_ == files_.size()) return std::nullopt;
        if (const auto opened = open_file(files_[next_file_++]); !opened) {
          return forward_error(opened);
        }
      }
      const auto row = step(file(), database_.get(), query_.get());
      if (!row) return forward_error(row);
      if (*row) return read_row();
      query_.reset();
    }
  }

 private:
  const std::string& file() const { return files_[next_file_ - 1]; }

  Result<void> open_file(const std::string& file) {
    query_.reset();
    auto database = open_database(file);
    if (!database) return forward_error(database);
    database_ = *std::move(database);
    auto query = prepare(file, database_.get(),
                         "SELECT data FROM messages WHERE topic_id IN (SELECT id FROM topics "
                         "WHERE name = ?1) ORDER BY timestamp, id");
    if (!query) return forward_error(query);
    query_ = *std::move(query);
    sqlite3_bind_text(query_.get(), 1, topic_.c_str(), -1, SQLITE_TRANSIENT);
    message_ = 0;
    return {};
  }

  Result<std::optional<BagMessage>> read_row() {
    BagMessage message;
    message.place = fmt::format("{}: message {} of {}", file(), ++message_, topic_);
    const void* data = sqlite3_column_blob(query_.get(), 0);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(query_.get(), 0));
    if (size > kMaxMessageBytes) {
      return fail(ErrorCode::bad_data, "{}: {} bytes are more than any scan has", message.place,
                  size);
    }
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    if (bytes != nullptr) message.bytes.assign(bytes, bytes + size);
    return message;
  }

  std::vector<std::string> files_;
  std::string topic_;
  std::size_t next_file_ = 0;
  std::size_t message_ = 0;  ///< in this file, from 1
  Database database_;
  Statement query_;  ///< declared last: finalised before its database closes
};

/// When the file's first message was recorded.
Result<std::int64_t> first_time(const std::string& file) {
  const auto database = open_database(file);
  if (!database) return forward_error(database);
  const auto query = prepare(file, database->get(), "SELECT min(timestamp) FROM messages");
  if (!query) return forward_error(query);
  if (const auto row = step(file, database->get(), query->get()); !row) return forward_error(row);
  return sqlite3_column_int64(query->get(), 0);
}

}  // namespace

Result<std::vector<BagTopic>> sqlite_topics(const std::string& file) {
  const auto database = open_database(file);
  if (!database) return forward_error(database);
  const auto query = prepare(file, database->get(),
                             "SELECT name, type, serialization_format FROM topics ORDER BY id");
  if (!query) return forward_error(query);
  std::vector<BagTopic> topics;
  for (;;) {
    const auto row = step(file, database->get(), query->get());
    if (!row) return forward_error(row);
    if (!*row || topics.size() == kMaxTopics) return topics;
    topics.push_back({column_text(query->get(), 0), column_text(query->get(), 1)});
    if (const std::string format = column_text(query->get(), 2); format != "cdr") {
      return fail(ErrorCode::unsupported, "{}: topic {} is serialized as '{}', only cdr is known",
                  file, topics.back().name, format);
    }
  }
}

Result<BagStream> open_sqlite_topic(const std::vector<std::string>& files,
                                    const std::string& topic) {
  std::vector<std::pair<std::int64_t, std::string>> by_time;
  for (const std::string& file : files) {
    const auto time = first_time(file);
    if (!time) return forward_error(time);
    by_time.emplace_back(*time, file);
  }
  std::sort(by_time.begin(), by_time.end());
  std::vector<std::string> ordered;
  for (auto& [time, file] : by_time) ordered.push_back(std::move(file));
  auto reader = std::make_shared<SqliteTopic>(std::move(ordered), topic);
  return [reader] { return reader->next(); };
}

}  // namespace lifeline::sources
