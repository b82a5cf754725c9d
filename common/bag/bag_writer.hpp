#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/bag/bag_metadata.hpp"
#include "common/bag/message_source.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::bag {

/// Writes a rosbag2 recording: FOLDER/NAME_0.db3 in the form of ROS 2 Humble, and metadata.yaml.
/// What was committed is on disk, whatever becomes of process or power: a write-ahead log takes it
/// first, and readers take the log in. One thread.
class BagWriter {
 public:
  /// Makes the folder. wrong_use where it exists already (nothing is ever written over);
  /// unavailable where it cannot be made or written.
  [[nodiscard]] static Result<BagWriter> create(const std::filesystem::path& folder);

  BagWriter(BagWriter&&) noexcept = default;
  BagWriter& operator=(BagWriter&&) noexcept = default;
  ~BagWriter() = default;

  /// Adds a message, which commit() makes last. After an error nothing of what was added since the
  /// last commit is there, and the next append() may succeed again.
  [[nodiscard]] Result<void> append(const Topic& topic, Durability durability, Timestamp stamp,
                                    std::span<const std::uint8_t> cdr);
  /// As append(), an error takes back all since the last commit.
  [[nodiscard]] Result<void> commit();
  /// Rewrites metadata.yaml, whole or not at all, to say what was committed.
  [[nodiscard]] Result<void> write_metadata() const;
  /// Commits, takes in the log, so that the .db3 file is complete by itself, and writes the
  /// metadata. Nothing can be appended afterwards.
  [[nodiscard]] Result<void> close();

  using Wanted = std::function<bool(const Topic&)>;
  /// What was committed, in the order in which it was appended: looks at most at `most` messages
  /// behind the first `after`, gives those of `wanted` topics, and moves `after` on. Nobody else
  /// can read while this writes: its lock keeps them out. unavailable once closed, or where the
  /// disk refuses.
  [[nodiscard]] Result<std::vector<Message>> read(std::uint64_t& after, std::uint64_t most,
                                                  const Wanted& wanted);
  /// Of what was committed.
  [[nodiscard]] std::optional<MessageSource::Span> span() const;

  /// How many were committed, and how many wait for it.
  [[nodiscard]] std::uint64_t messages() const { return metadata_.messages; }
  [[nodiscard]] std::uint64_t pending() const { return pending_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Row {
    std::int64_t id = 0;
    std::size_t place = 0;  ///< in metadata_.topics
    std::uint64_t pending = 0;
    bool committed = false;
  };

  BagWriter() = default;
  [[nodiscard]] Result<void> open(const std::filesystem::path& folder);
  [[nodiscard]] Result<void> execute(const char* sql);
  [[nodiscard]] Result<store::Statement> prepare(const char* sql);
  [[nodiscard]] Result<Row*> row_of(const Topic& topic, Durability durability);
  [[nodiscard]] Result<void> insert(const Row& row, Timestamp stamp,
                                    std::span<const std::uint8_t> cdr);
  [[nodiscard]] tl::unexpected<Error> failure() const;
  void take_back();

  std::filesystem::path folder_;
  std::string file_;
  store::Database database_;
  store::Statement insert_topic_, insert_message_, read_messages_;
  Metadata metadata_;  ///< of what was committed
  std::map<std::string, Row> rows_;
  bool begun_ = false;  ///< a transaction
  std::uint64_t pending_ = 0;
  std::int64_t pending_first_ns_ = 0, pending_last_ns_ = 0;
};

}  // namespace lifeline::bag
