#include "agents/sources/sqlite_bag.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "common/bag/bag_file.hpp"

namespace lifeline::sources {
namespace {

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
      const auto row = file_->step(query_.get());
      if (!row) return forward_error(row);
      if (*row) return read_row();
      query_.reset();
    }
  }

 private:
  Result<void> open_file(const std::string& file) {
    query_.reset();
    auto opened = bag::BagFile::open(file);
    if (!opened) return forward_error(opened);
    file_ = *std::move(opened);
    auto query = file_->prepare(
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
    message.place = fmt::format("{}: message {} of {}", file_->name(), ++message_, topic_);
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
  std::optional<bag::BagFile> file_;
  store::Statement query_;  ///< declared last: finalised before its file closes
};

}  // namespace

Result<std::vector<BagTopic>> sqlite_topics(const std::string& file) {
  const auto opened = bag::BagFile::open(file);
  if (!opened) return forward_error(opened);
  return bag::topics_of(*opened);
}

Result<BagStream> open_sqlite_topic(const std::vector<std::string>& files,
                                    const std::string& topic) {
  auto ordered = bag::by_time(files);
  if (!ordered) return forward_error(ordered);
  auto reader = std::make_shared<SqliteTopic>(*std::move(ordered), topic);
  return [reader] { return reader->next(); };
}

}  // namespace lifeline::sources
