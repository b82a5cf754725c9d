#include "tests/support/recordings.hpp"

#include <fstream>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <zlib.h>

#include "agents/sources/open_source.hpp"

namespace lifeline::test {
namespace {

void require(bool condition, std::string_view what) {
  if (!condition) throw std::runtime_error(fmt::format("cannot write a test recording: {}", what));
}

std::string little_endian(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

std::string block(std::string_view content) {
  return little_endian(content.size(), 4) + std::string(content);
}

std::string field(std::string_view name, std::string_view value) {
  return block(fmt::format("{}=", name) + std::string(value));
}

std::string record(char op, std::string_view fields, std::string_view data,
                   std::size_t stated_length) {
  return block(field("op", std::string(1, op)) + std::string(fields)) +
         little_endian(stated_length, 4) + std::string(data);
}

std::string record(char op, std::string_view fields, std::string_view data) {
  return record(op, fields, data, data.size());
}

}  // namespace

RecordingFolder::RecordingFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "lifeline-test-XXXXXX").string();
  require(mkdtemp(name.data()) != nullptr, name);
  folder_ = name;
}

RecordingFolder::~RecordingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string RecordingFolder::path(std::string_view name) const {
  return (folder_ / name).string();
}

std::string RecordingFolder::write(std::string_view name, std::string_view content) const {
  std::ofstream(path(name), std::ios::binary) << content;
  return path(name);
}

std::string RecordingFolder::write_gz(std::string_view name, std::string_view content) const {
  gzFile file = gzopen(path(name).c_str(), "wb");
  require(file != nullptr, name);
  require(gzwrite(file, content.data(), static_cast<unsigned>(content.size())) ==
              static_cast<int>(content.size()),
          name);
  gzclose(file);
  return path(name);
}

Played play(std::string_view source) {
  Played played;
  const auto opened = sources::open_source(source);
  if (!opened) {
    played.error = opened.error().text;
    played.code = opened.error().code;
    return played;
  }
  for (;;) {
    auto scan = (*opened)->next();
    if (!scan) {
      played.error = scan.error().text;
      played.code = scan.error().code;
      return played;
    }
    if (!*scan) return played;
    played.scans.push_back(**std::move(scan));
  }
}

std::string flaser_line(std::size_t beams, int k, std::string_view time) {
  std::string line = fmt::format("FLASER {}", beams);
  for (std::size_t i = 0; i < beams; ++i) line += fmt::format(" {}.00", 1 + k);
  return line + fmt::format(" {} {} {:.2f} {} {} {:.2f} {} host {}\n", k, 2 * k, 0.1 * k, 10 + k,
                            20 + k, 0.2 * k, time, time);
}

std::string carmen_log(std::size_t beams, int scans) {
  std::string log = "# a log\nPARAM laser_front_laser_resolution 1.0\n";
  for (int k = 0; k < scans; ++k) {
    log += fmt::format("ODOM {} 0 0 0 0 0 {} host {}\n", k, 100 + k, 100 + k);
    log += flaser_line(beams, k, fmt::format("{}.25", 100 + k));
  }
  return log;
}

MessageWriter::MessageWriter(Encoding encoding) : encoding_(encoding) {
  if (encoding == Encoding::cdr_little) bytes_ = {0, 1, 0, 0};
  if (encoding == Encoding::cdr_big) bytes_ = {0, 0, 0, 0};
}

void MessageWriter::align(std::size_t size) {
  if (encoding_ == Encoding::ros1) return;
  while (bytes_.size() < 4 || (bytes_.size() - 4) % size != 0) bytes_.push_back(0);
}

MessageWriter& MessageWriter::add_text(std::string_view text) {
  const bool closing_zero = encoding_ != Encoding::ros1;
  add(static_cast<std::uint32_t>(text.size() + (closing_zero ? 1 : 0)));
  bytes_.insert(bytes_.end(), text.begin(), text.end());
  if (closing_zero) bytes_.push_back(0);
  return *this;
}

MessageWriter& MessageWriter::add_floats(const std::vector<float>& values) {
  add(static_cast<std::uint32_t>(values.size()));
  for (const float value : values) add(value);
  return *this;
}

MessageWriter& MessageWriter::add_header(std::uint32_t seconds, std::uint32_t nanoseconds) {
  if (encoding_ == Encoding::ros1) add(std::uint32_t{7});
  return add(seconds).add(nanoseconds).add_text("laser");
}

std::vector<std::uint8_t> laser_message(const LaserFields& fields, Encoding encoding) {
  MessageWriter writer(encoding);
  writer.add_header(fields.seconds, fields.nanoseconds);
  for (const float value : {fields.angle_min, 9.0F, fields.angle_increment, fields.time_increment,
                            0.1F, fields.range_min, fields.range_max}) {
    writer.add(value);
  }
  return writer.add_floats(fields.ranges).add_floats({5.0F, 6.0F}).bytes();
}

std::vector<std::uint8_t> imu_message(const ImuFields& fields, Encoding encoding) {
  MessageWriter writer(encoding);
  writer.add_header(fields.seconds, fields.nanoseconds);
  for (const double value : {fields.x, fields.y, fields.z, fields.w, fields.first_covariance}) {
    writer.add(value);
  }
  for (int i = 0; i < 32; ++i) writer.add(0.5 * i);
  return writer.bytes();
}

void write_db3(const std::string& path, const std::vector<TopicToWrite>& topics,
               const std::vector<MessageToWrite>& messages) {
  sqlite3* database = nullptr;
  require(sqlite3_open(path.c_str(), &database) == SQLITE_OK, path);
  const auto run = [&](const std::string& sql, const std::vector<std::uint8_t>* blob) {
    sqlite3_stmt* statement = nullptr;
    require(sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK, sql);
    if (blob != nullptr && blob->empty()) sqlite3_bind_zeroblob(statement, 1, 0);
    if (blob != nullptr && !blob->empty()) {
      sqlite3_bind_blob(statement, 1, blob->data(), static_cast<int>(blob->size()), SQLITE_STATIC);
    }
    require(sqlite3_step(statement) == SQLITE_DONE, sql);
    sqlite3_finalize(statement);
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)",
      nullptr);
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER "
      "NOT NULL, data BLOB NOT NULL)",
      nullptr);
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)", nullptr);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    run(fmt::format("INSERT INTO topics VALUES ({}, '{}', '{}', '{}', '')", i + 1, topics[i].name,
                    topics[i].type, topics[i].serialization),
        nullptr);
  }
  for (const MessageToWrite& message : messages) {
    run(fmt::format("INSERT INTO messages (topic_id, timestamp, data) VALUES ({}, {}, ?1)",
                    message.topic + 1, message.time_ns),
        &message.bytes);
  }
  sqlite3_close(database);
}

std::string ros1_bag(const std::vector<TopicToWrite>& topics,
                     const std::vector<MessageToWrite>& messages, const BagStyle& style) {
  const std::string bag_header = record(3, field("index_pos", little_endian(0, 8)), "    ");
  std::string bag = "#ROSBAG V2.0\n" + bag_header;
  for (const MessageToWrite& message : messages) {
    const TopicToWrite& topic = topics[message.topic];
    const std::string connection = field("conn", little_endian(message.topic, 4));
    const std::string time = field("time", little_endian(0, 8));
    const std::string records =
        record(7, connection + field("topic", topic.name),
               field("topic", topic.name) + field("type", topic.type)) +
        record(2, connection + time,
               {reinterpret_cast<const char*>(message.bytes.data()), message.bytes.size()});
    bag += record(
        5,
        field("compression", style.compression) + field("size", little_endian(records.size(), 4)),
        records);
    bag += record(
        4, connection + field("ver", little_endian(1, 4)) + field("count", little_endian(1, 4)),
        std::string(12, '\0'), 12 + style.extra_index_length);
  }
  for (std::size_t i = 0; i < topics.size(); ++i) {
    bag += record(7, field("conn", little_endian(i, 4)) + field("topic", topics[i].name),
                  field("topic", topics[i].name) + field("type", topics[i].type));
  }
  return bag;
}

}  // namespace lifeline::test
