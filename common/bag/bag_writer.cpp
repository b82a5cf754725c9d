#include "common/bag/bag_writer.hpp"

#include <algorithm>

#include "common/base/check.hpp"
#include "common/files/atomic_file.hpp"

namespace lifeline::bag {
namespace {

// The tables of rosbag2's third schema, which Humble writes and all later ones read.
constexpr const char* kSchema =
    "BEGIN;"
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
    "INSERT INTO schema VALUES(3, 'humble');"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata "
    "TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
    "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER "
    "NOT NULL, data BLOB NOT NULL);"
    "CREATE INDEX timestamp_idx ON messages(timestamp ASC);"
    "COMMIT";

void bind_text(const store::Statement& statement, int index, const std::string& text) {
  sqlite3_bind_text(statement.get(), index, text.c_str(), static_cast<int>(text.size()),
                    SQLITE_TRANSIENT);
}

}  // namespace

Result<BagWriter> BagWriter::create(const std::filesystem::path& folder) {
  std::error_code problem;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), problem);
  if (!problem && !std::filesystem::create_directory(folder, problem) && !problem) {
    return fail(ErrorCode::wrong_use, "{}: is there already; a recording never writes over one",
                folder.string());
  }
  if (problem) {
    return fail(ErrorCode::unavailable,
                "{}: cannot be made ({}); give a folder that can be written", folder.string(),
                problem.message());
  }
  BagWriter writer;
  if (auto opened = writer.open(folder); !opened) return forward_error(opened);
  return writer;
}

Result<void> BagWriter::open(const std::filesystem::path& folder) {
  folder_ = folder;
  metadata_.file = folder.filename().string() + "_0.db3";
  file_ = (folder / metadata_.file).string();
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(file_.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) return failure();
  for (const char* sql : store::kCrashSafe) {
    if (auto done = execute(sql); !done) return done;
  }
  if (auto made = execute(kSchema); !made) return made;
  auto topic = prepare("INSERT INTO topics VALUES(?1, ?2, ?3, 'cdr', ?4)");
  if (!topic) return forward_error(topic);
  auto message = prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES(?1, ?2, ?3)");
  if (!message) return forward_error(message);
  auto read = prepare(
      "SELECT topic_id, timestamp, data FROM messages WHERE id > ?1 AND id <= ?2 ORDER BY id");
  if (!read) return forward_error(read);
  insert_topic_ = *std::move(topic);
  insert_message_ = *std::move(message);
  read_messages_ = *std::move(read);
  return write_metadata();
}

Result<void> BagWriter::execute(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return failure();
  return {};
}

Result<store::Statement> BagWriter::prepare(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK) {
    return failure();
  }
  return store::Statement(statement);
}

tl::unexpected<Error> BagWriter::failure() const {
  return fail(ErrorCode::unavailable, "{}: cannot be written ({}); make room on the disk", file_,
              sqlite3_errmsg(database_.get()));
}

Result<BagWriter::Row*> BagWriter::row_of(const Topic& topic, Durability durability) {
  Row& row = rows_[topic.name];
  if (row.id != 0) return &row;
  const std::string qos = qos_text(durability);
  const auto id = static_cast<std::int64_t>(rows_.size());
  sqlite3_reset(insert_topic_.get());
  sqlite3_bind_int64(insert_topic_.get(), 1, id);
  bind_text(insert_topic_, 2, topic.name);
  bind_text(insert_topic_, 3, topic.type);
  bind_text(insert_topic_, 4, qos);
  const int code = sqlite3_step(insert_topic_.get());
  if (code != SQLITE_DONE) return failure();
  sqlite3_reset(insert_topic_.get());
  row.id = id;
  row.place = metadata_.topics.size();
  metadata_.topics.push_back({topic, qos, 0});
  return &row;
}

Result<void> BagWriter::append(const Topic& topic, Durability durability, Timestamp stamp,
                               std::span<const std::uint8_t> cdr) {
  if (!begun_) {
    if (auto begun = execute("BEGIN IMMEDIATE"); !begun) return begun;
    begun_ = true;
  }
  auto row = row_of(topic, durability);
  const auto inserted = row ? insert(**row, stamp, cdr) : Result<void>(tl::unexpected(row.error()));
  if (!inserted) {
    take_back();
    return inserted;
  }
  const std::int64_t at_ns = stamp.time_since_epoch().count();
  pending_first_ns_ = pending_ == 0 ? at_ns : std::min(pending_first_ns_, at_ns);
  pending_last_ns_ = pending_ == 0 ? at_ns : std::max(pending_last_ns_, at_ns);
  ++(*row)->pending;
  ++pending_;
  return {};
}

Result<void> BagWriter::insert(const Row& row, Timestamp stamp, std::span<const std::uint8_t> cdr) {
  sqlite3_stmt* statement = insert_message_.get();
  sqlite3_bind_int64(statement, 1, row.id);
  sqlite3_bind_int64(statement, 2, stamp.time_since_epoch().count());
  sqlite3_bind_blob64(statement, 3, cdr.data(), cdr.size(), SQLITE_STATIC);
  const int code = sqlite3_step(statement);
  if (code != SQLITE_DONE) {
    auto failed = failure();
    sqlite3_reset(statement);
    return failed;
  }
  sqlite3_reset(statement);
  return {};
}

Result<void> BagWriter::commit() {
  if (!begun_) return {};
  if (auto committed = execute("COMMIT"); !committed) {
    take_back();
    return committed;
  }
  begun_ = false;
  for (auto& [name, row] : rows_) {
    metadata_.topics[row.place].messages += row.pending;
    row.pending = 0;
    row.committed = true;
  }
  if (pending_ > 0) {
    metadata_.first_ns = metadata_.messages == 0 ? pending_first_ns_
                                                 : std::min(metadata_.first_ns, pending_first_ns_);
    metadata_.last_ns =
        metadata_.messages == 0 ? pending_last_ns_ : std::max(metadata_.last_ns, pending_last_ns_);
  }
  metadata_.messages += pending_;
  pending_ = 0;
  return {};
}

void BagWriter::take_back() {
  sqlite3_reset(insert_topic_.get());
  // SQLite may have taken it back by itself: then this fails, and nothing is left to do.
  (void)execute("ROLLBACK");
  begun_ = false;
  pending_ = 0;
  std::erase_if(rows_, [](const auto& row) { return !row.second.committed; });
  metadata_.topics.resize(rows_.size());
  for (auto& [name, row] : rows_) row.pending = 0;
}

Result<void> BagWriter::write_metadata() const {
  return files::write_file_atomically(folder_ / "metadata.yaml", to_yaml(metadata_));
}

Result<void> BagWriter::close() {
  if (auto committed = commit(); !committed) return committed;
  insert_topic_.reset();
  insert_message_.reset();
  read_messages_.reset();
  // Back to a file that who may only read can open.
  if (auto done = execute("PRAGMA journal_mode = DELETE"); !done) return done;
  database_.reset();
  return write_metadata();
}

Result<std::vector<Message>> BagWriter::read(std::uint64_t& after, std::uint64_t most,
                                             const Wanted& wanted) {
  if (!read_messages_) return fail(ErrorCode::unavailable, "{}: is closed", file_);
  // Ids count messages: nothing is ever removed but what was never committed.
  const std::uint64_t until = std::min(after + most, metadata_.messages);
  std::vector<Message> messages;
  sqlite3_stmt* row = read_messages_.get();
  sqlite3_bind_int64(row, 1, static_cast<std::int64_t>(after));
  sqlite3_bind_int64(row, 2, static_cast<std::int64_t>(until));
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(row)) == SQLITE_ROW) {
    const auto place = static_cast<std::size_t>(sqlite3_column_int64(row, 0)) - 1;
    LIFELINE_CHECK(place < metadata_.topics.size());
    const Topic& topic = metadata_.topics[place].topic;
    if (!wanted(topic)) continue;  // its data stays on the disk
    Message message{topic, Timestamp(Duration(sqlite3_column_int64(row, 1))), {}};
    const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(row, 2));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, 2));
    if (bytes != nullptr) message.cdr.assign(bytes, bytes + size);
    messages.push_back(std::move(message));
  }
  // Left open it would hold the log, which could not be taken in.
  sqlite3_reset(row);
  if (code != SQLITE_DONE) {
    return fail(ErrorCode::unavailable, "{}: cannot be read back ({})", file_,
                sqlite3_errstr(code));
  }
  after = std::max(after, until);
  return messages;
}

std::optional<MessageSource::Span> BagWriter::span() const {
  if (metadata_.messages == 0) return std::nullopt;
  return MessageSource::Span{Timestamp(Duration(metadata_.first_ns)),
                             Timestamp(Duration(metadata_.last_ns))};
}

}  // namespace lifeline::bag
