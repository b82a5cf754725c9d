#include "common/store/record_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "common/base/sha256.hpp"
#include "common/store/file_lock.hpp"

namespace lifeline::store {
namespace {

constexpr int kApplicationId = 0x4c464c53;  // "LFLS"
constexpr const char* kSchema =
    "CREATE TABLE record(key TEXT PRIMARY KEY NOT NULL, value BLOB NOT NULL, sum BLOB NOT NULL)";
constexpr std::size_t kSumOctets = 8;
using Sum = std::array<std::uint8_t, kSumOctets>;

Sum sum_of(std::string_view key, std::span<const std::uint8_t> value) {
  Sha256 hash;
  hash.add_text(std::string(key)).add(value);
  const Sha256Digest digest = hash.finish();
  Sum sum{};
  std::memcpy(sum.data(), digest.data(), sum.size());
  return sum;
}

std::span<const std::uint8_t> octets_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string_view column(sqlite3_stmt* row, int index) {
  const void* data = sqlite3_column_blob(row, index);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, index));
  return data == nullptr ? std::string_view()
                         : std::string_view(static_cast<const char*>(data), size);
}

tl::unexpected<FileFailure> damaged(const std::filesystem::path& file, std::string_view reason) {
  std::string line(reason);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return tl::unexpected(
      FileFailure{FileProblem::damaged, fmt::format("{}: is damaged: {}", file.string(), line)});
}

bool means_damage(int code) {
  // A file shorter than its header says shows as a short read.
  return (code & 0xff) == SQLITE_CORRUPT || (code & 0xff) == SQLITE_NOTADB ||
         code == SQLITE_IOERR_SHORT_READ;
}

}  // namespace

FileResult<RecordFile> RecordFile::open(const std::filesystem::path& file) {
  std::error_code problem;
  std::filesystem::create_directories(file.parent_path(), problem);
  const auto lock = take_lock(file);
  if (!lock && lock.error().held) {
    return tl::unexpected(FileFailure{
        FileProblem::in_use,
        fmt::format("{}: is in use by {}; stop that one, or give another --state folder or --id",
                    file.string(), lock.error().reason)});
  }
  if (!lock) {
    return tl::unexpected(
        FileFailure{FileProblem::refused,
                    fmt::format("{}: cannot be opened ({}); give a folder that can be written",
                                file.string(), lock.error().reason)});
  }
  RecordFile opened(file, *lock);
  if (auto ready = opened.open_database(); !ready) return tl::unexpected(ready.error());
  return opened;
}

RecordFile::RecordFile(RecordFile&& other) noexcept
    : path_(std::move(other.path_)),
      lock_(std::exchange(other.lock_, -1)),
      database_(std::move(other.database_)),
      put_(std::move(other.put_)),
      erase_(std::move(other.erase_)) {}

RecordFile& RecordFile::operator=(RecordFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(lock_, other.lock_);
  std::swap(database_, other.database_);
  std::swap(put_, other.put_);
  std::swap(erase_, other.erase_);
  return *this;
}

RecordFile::~RecordFile() {
  put_.reset();
  erase_.reset();
  database_.reset();
  if (lock_ >= 0) ::close(lock_);
}

FileResult<void> RecordFile::open_database() {
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(path_.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) return failure();
  sqlite3_extended_result_codes(database_.get(), 1);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(2 * kMaxValue));
  if (auto ready = set_up(); !ready) return ready;
  auto put = prepare(
      "INSERT INTO record(key, value, sum) VALUES(?1, ?2, ?3) ON CONFLICT(key) DO UPDATE SET "
      "value = excluded.value, sum = excluded.sum");
  if (!put) return tl::unexpected(put.error());
  auto erase = prepare("DELETE FROM record WHERE key = ?1");
  if (!erase) return tl::unexpected(erase.error());
  put_ = *std::move(put);
  erase_ = *std::move(erase);
  return {};
}

FileResult<void> RecordFile::set_up() {
  for (const char* sql : kCrashSafe) {
    if (auto done = execute(sql); !done) return done;
  }
  auto application = ask("PRAGMA application_id");
  if (!application) return tl::unexpected(application.error());
  auto tables = ask("SELECT count(*) FROM sqlite_master");
  if (!tables) return tl::unexpected(tables.error());
  if (*application == "0" && *tables == "0") {
    const std::string begin =
        fmt::format("BEGIN; PRAGMA application_id = {}; {}; COMMIT", kApplicationId, kSchema);
    return execute(begin.c_str());
  }
  if (*application != std::to_string(kApplicationId)) {
    return damaged(path_, "it is no state file of this program");
  }
  return check_schema();
}

FileResult<void> RecordFile::check_schema() {
  // Our own table and its index, nothing else: a view or a trigger could do anything.
  auto tables =
      ask("SELECT group_concat(type || ' ' || name || ' ' || coalesce(sql, '')) FROM "
          "sqlite_master");
  if (!tables) return tl::unexpected(tables.error());
  const std::string expected =
      std::string("table record ") + kSchema + ",index sqlite_autoindex_record_1 ";
  if (*tables != expected) return damaged(path_, "it holds other tables than ours");
  auto sound = ask("PRAGMA quick_check(1)");
  if (!sound) return tl::unexpected(sound.error());
  if (*sound != "ok") return damaged(path_, *sound);
  return {};
}

FileResult<Records> RecordFile::read_all() const {
  auto rows = prepare("SELECT key, value, sum FROM record");
  if (!rows) return tl::unexpected(rows.error());
  Records records;
  std::size_t octets = 0;
  for (;;) {
    const int code = sqlite3_step(rows->get());
    if (code == SQLITE_DONE) return records;
    if (code != SQLITE_ROW) return failure();
    const std::string_view key = column(rows->get(), 0), value = column(rows->get(), 1),
                           sum = column(rows->get(), 2);
    octets += key.size() + value.size();
    if (records.size() >= kMaxRecords || octets > kMaxOctets || value.size() > kMaxValue) {
      return damaged(path_, "it holds more than any state does");
    }
    const Sum right = sum_of(key, octets_of(value));
    if (sum.size() != right.size() || std::memcmp(sum.data(), right.data(), right.size()) != 0) {
      return damaged(path_, fmt::format("record {} is not as it was written", key.substr(0, 80)));
    }
    records.emplace(key, value);
  }
}

FileResult<void> RecordFile::write(const std::vector<RecordChange>& changes) {
  if (auto begun = execute("BEGIN IMMEDIATE"); !begun) return begun;
  FileResult<void> done;
  for (const RecordChange& change : changes) {
    if (done) done = apply(change);
  }
  if (done) done = execute("COMMIT");
  // Some failures roll back by themselves.
  if (!done && sqlite3_get_autocommit(database_.get()) == 0) {
    [[maybe_unused]] const auto undone = execute("ROLLBACK");
  }
  return done;
}

FileResult<void> RecordFile::apply(const RecordChange& change) {
  sqlite3_stmt* statement = change.value ? put_.get() : erase_.get();
  sqlite3_bind_text(statement, 1, change.key.data(), static_cast<int>(change.key.size()),
                    SQLITE_STATIC);
  Sum sum{};
  if (change.value) {
    sum = sum_of(change.key, octets_of(*change.value));
    sqlite3_bind_blob64(statement, 2, change.value->data(), change.value->size(), SQLITE_STATIC);
    sqlite3_bind_blob64(statement, 3, sum.data(), sum.size(), SQLITE_STATIC);
  }
  const int code = sqlite3_step(statement);
  auto outcome = code == SQLITE_DONE ? FileResult<void>() : FileResult<void>(failure());
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  return outcome;
}

FileResult<void> RecordFile::execute(const char* sql) const {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return failure();
  return {};
}

FileResult<Statement> RecordFile::prepare(const char* sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK) {
    return failure();
  }
  return Statement(statement);
}

FileResult<std::string> RecordFile::ask(const char* sql) const {
  auto row = prepare(sql);
  if (!row) return tl::unexpected(row.error());
  const int code = sqlite3_step(row->get());
  if (code == SQLITE_DONE) return std::string();
  if (code != SQLITE_ROW) return failure();
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row->get(), 0));
  return std::string(text == nullptr ? "" : text);
}

tl::unexpected<FileFailure> RecordFile::failure() const {
  const char* reason = sqlite3_errmsg(database_.get());
  if (means_damage(sqlite3_extended_errcode(database_.get()))) return damaged(path_, reason);
  return tl::unexpected(FileFailure{
      FileProblem::refused,
      fmt::format("{}: the disk refuses ({}); make room or give a folder that can be written",
                  path_.string(), reason)});
}

}  // namespace lifeline::store
