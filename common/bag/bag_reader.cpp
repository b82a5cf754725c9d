#include "common/bag/bag_reader.hpp"

#include <algorithm>
#include <filesystem>

namespace lifeline::bag {

Result<BagReader> BagReader::open(const std::string& target) {
  BagReader reader(target);
  std::error_code ignored;
  std::vector<std::string> files{target};
  if (std::filesystem::is_directory(target, ignored)) files = files_ending(target, ".db3");
  if (files.empty()) {
    return fail(ErrorCode::not_found, "{}: holds no .db3 file; give a recording's folder", target);
  }
  auto ordered = by_time(files);
  if (!ordered) return forward_error(ordered);
  reader.files_ = *std::move(ordered);
  return reader;
}

Result<void> BagReader::open_next() {
  query_.reset();
  auto file = BagFile::open(files_[next_file_++]);
  if (!file) return forward_error(file);
  file_ = *std::move(file);
  // CDR alone is read on.
  if (auto topics = topics_of(*file_); !topics) return forward_error(topics);
  auto query = file_->prepare(
      "SELECT topics.name, topics.type, messages.timestamp, messages.data FROM messages JOIN "
      "topics ON topics.id = messages.topic_id ORDER BY messages.timestamp, messages.id");
  if (!query) return forward_error(query);
  query_ = *std::move(query);
  return {};
}

Result<std::optional<Message>> BagReader::next() {
  for (;;) {
    if (!query_) {
      if (next_file_ == files_.size()) return std::nullopt;
      if (auto opened = open_next(); !opened) return forward_error(opened);
    }
    const auto row = file_->step(query_.get());
    if (!row) return forward_error(row);
    if (!*row) {
      query_.reset();
      continue;
    }
    Message message{{column_text(query_.get(), 0), column_text(query_.get(), 1)},
                    Timestamp(Duration(sqlite3_column_int64(query_.get(), 2))),
                    {}};
    const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(query_.get(), 3));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(query_.get(), 3));
    if (bytes != nullptr) message.cdr.assign(bytes, bytes + size);
    return message;
  }
}

Result<std::optional<BagReader::Span>> BagReader::span() const {
  std::optional<Span> span;
  for (const std::string& name : files_) {
    const auto file = BagFile::open(name);
    if (!file) return forward_error(file);
    const auto query =
        file->prepare("SELECT count(*), min(timestamp), max(timestamp) FROM messages");
    if (!query) return forward_error(query);
    if (const auto row = file->step(query->get()); !row) return forward_error(row);
    if (sqlite3_column_int64(query->get(), 0) == 0) continue;
    const Timestamp first{Duration(sqlite3_column_int64(query->get(), 1))};
    const Timestamp last{Duration(sqlite3_column_int64(query->get(), 2))};
    span =
        span ? Span{std::min(span->first, first), std::max(span->last, last)} : Span{first, last};
  }
  return span;
}

}  // namespace lifeline::bag
