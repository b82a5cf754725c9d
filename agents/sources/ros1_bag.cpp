#include "agents/sources/ros1_bag.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

namespace lifeline::sources {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::uint32_t kMaxHeaderBytes = 64 * 1024;
constexpr std::uint32_t kMaxConnectionBytes = 1024 * 1024;  // message definitions are long
constexpr std::size_t kMaxTopics = 10'000;

enum Op : std::uint8_t { kMessage = 2, kIndex = 4, kChunk = 5, kConnection = 7 };

using Fields = std::map<std::string, std::string, std::less<>>;

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = std::min<std::size_t>(bytes.size(), 4); i-- > 0;) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  }
  return value;
}

/// `length name=value` over and over; false where the lengths do not work out.
bool parse_fields(std::string_view bytes, Fields& fields) {
  while (!bytes.empty()) {
    const std::size_t length = little_endian(bytes);
    if (bytes.size() < 4 || length > bytes.size() - 4) return false;
    const std::string_view field = bytes.substr(4, length);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return false;
    fields.insert_or_assign(std::string(field.substr(0, equals)),
                            std::string(field.substr(equals + 1)));
    bytes.remove_prefix(4 + length);
  }
  return true;
}

std::string_view field(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string_view() : std::string_view(found->second);
}

/// Walks a bag record by record. An uncompressed chunk is entered as if its records stood in the
/// file itself, so that no chunk is ever held.
class Ros1Reader {
 public:
  struct Record {
    std::uint8_t op = 0;
    Fields header;
    std::uint32_t data_bytes = 0;  ///< at the reader's position, until the next call
  };

  static Result<Ros1Reader> open(const std::string& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return fail(ErrorCode::not_found, "{}: no such file", file);
    Ros1Reader reader(file, size);
    std::array<char, kMagic.size()> magic{};
    reader.stream_.read(magic.data(), magic.size());
    if (!reader.stream_ || std::string_view(magic.data(), magic.size()) != kMagic) {
      return fail(ErrorCode::bad_data, "{}: is no ROS 1 bag of format 2.0", file);
    }
    reader.at_ = kMagic.size();
    return reader;
  }

  /// The next record, past what the last one has left unread; empty at the end.
  Result<std::optional<Record>> next() {
    if (at_ == size_) return std::nullopt;
    record_ = at_;
    stream_.seekg(static_cast<std::streamoff>(at_));
    const auto header = read_block(kMaxHeaderBytes);
    if (!header) return forward_error(header);
    Record record;
    if (!parse_fields(*header, record.header) || field(record.header, "op").size() != 1) {
      return fail_here("its header makes no sense");
    }
    record.op = static_cast<std::uint8_t>(field(record.header, "op")[0]);
    std::array<char, 4> length{};
    if (!read(length.data(), length.size())) return fail_here("the file is cut off");
    record.data_bytes = little_endian({length.data(), length.size()});
    // Some writers give an index record a length that is too long; what its count says is true.
    if (record.op == kIndex) {
      const std::uint64_t bytes = 12ULL * little_endian(field(record.header, "count"));
      record.data_bytes = static_cast<std::uint32_t>(std::min<std::uint64_t>(bytes, UINT32_MAX));
    }
    if (record.data_bytes > size_ - at_) return fail_here("the file is cut off");
    if (record.op != kChunk) {
      at_ += record.data_bytes;
    } else if (field(record.header, "compression") != "none") {
      return fail(ErrorCode::unsupported, "{}: its chunks are compressed: run rosbag decompress",
                  file_);
    }
    return record;
  }

  /// The data of the record that next() gave last.
  Result<std::string> read_data(const Record& record, std::uint32_t most) {
    if (record.data_bytes > most) return fail_here("it is longer than such a record can be");
    std::string data(record.data_bytes, '\0');
    stream_.read(data.data(), static_cast<std::streamsize>(data.size()));
    if (!stream_) return fail_here("it cannot be read");
    return data;
  }

  tl::unexpected<Error> fail_here(std::string_view text) const {
    return fail(ErrorCode::bad_data, "{}: record at byte {}: {}", file_, record_, text);
  }

  const std::string& file() const { return file_; }

 private:
  Ros1Reader(std::string file, std::uintmax_t size)
      : file_(std::move(file)), stream_(file_, std::ios::binary), size_(size) {}

  bool read(char* into, std::size_t count) {
    if (count > size_ - at_) return false;
    stream_.read(into, static_cast<std::streamsize>(count));
    at_ += count;
    return static_cast<bool>(stream_);
  }

  Result<std::string> read_block(std::uint32_t most) {
    std::array<char, 4> length_bytes{};
    if (!read(length_bytes.data(), length_bytes.size())) return fail_here("the file is cut off");
    const std::uint32_t length = little_endian({length_bytes.data(), length_bytes.size()});
    if (length > most) return fail_here("its header is too long");
    std::string block(length, '\0');
    if (!read(block.data(), block.size())) return fail_here("the file is cut off");
    return block;
  }

  std::string file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;      ///< where the next record begins
  std::uint64_t record_ = 0;  ///< where the last one began, for error texts
};

/// The topic and type that a connection record announces. Its own header has the topic, too.
Result<BagTopic> read_connection(Ros1Reader& reader, const Ros1Reader::Record& record) {
  const auto data = reader.read_data(record, kMaxConnectionBytes);
  if (!data) return forward_error(data);
  Fields fields;
  if (!parse_fields(*data, fields)) return reader.fail_here("its connection makes no sense");
  return BagTopic{std::string(field(record.header, "topic")), std::string(field(fields, "type"))};
}

class Ros1Topic {
 public:
  Ros1Topic(Ros1Reader reader, std::string topic)
      : reader_(std::move(reader)), topic_(std::move(topic)) {}

  Result<std::optional<BagMessage>> next() {
    for (;;) {
      const auto record = reader_.next();
      if (!record) return forward_error(record);
      if (!*record) return std::nullopt;
      const Fields& header = (*record)->header;
      const std::uint32_t connection = little_endian(field(header, "conn"));
      if ((*record)->op == kConnection && field(header, "topic") == topic_) {
        connections_.insert(connection);
      } else if ((*record)->op == kMessage && connections_.contains(connection)) {
        const auto data = reader_.read_data(**record, kMaxMessageBytes);
        if (!data) return forward_error(data);
        return BagMessage{{data->begin(), data->end()},
                          fmt::format("{}: message {} of {}", reader_.file(), ++message_, topic_)};
      }
    }
  }

 private:
  Ros1Reader reader_;
  std::string topic_;
  std::set<std::uint32_t> connections_;  ///< of the topic: one for each publisher
  std::size_t message_ = 0;              ///< from 1
};

}  // namespace

Result<std::vector<BagTopic>> ros1_topics(const std::string& file) {
  auto reader = Ros1Reader::open(file);
  if (!reader) return forward_error(reader);
  std::vector<BagTopic> topics;
  for (;;) {
    const auto record = reader->next();
    if (!record) return forward_error(record);
    if (!*record || topics.size() == kMaxTopics) return topics;
    if ((*record)->op != kConnection) continue;
    const auto topic = read_connection(*reader, **record);
    if (!topic) return forward_error(topic);
    const bool known = std::any_of(topics.begin(), topics.end(), [&](const BagTopic& other) {
      return other.name == topic->name;
    });
    if (!known) topics.push_back(*topic);
  }
}

Result<BagStream> open_ros1_topic(const std::string& file, const std::string& topic) {
  auto reader = Ros1Reader::open(file);
  if (!reader) return forward_error(reader);
  auto messages = std::make_shared<Ros1Topic>(*std::move(reader), topic);
  return [messages] { return messages->next(); };
}

}  // namespace lifeline::sources
