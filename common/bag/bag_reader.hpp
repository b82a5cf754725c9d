#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/bag/bag_file.hpp"
#include "common/base/time.hpp"

namespace lifeline::bag {

/// One message as it was recorded.
struct Message {
  Topic topic;
  Timestamp stamp{};  ///< when it was recorded, by the recorder's clock
  std::vector<std::uint8_t> cdr;
};

/// All messages of a rosbag2 recording (SQLite), file after file in the order of their beginnings,
/// within a file in the order of their stamps. From anywhere; metadata.yaml is not needed.
class BagReader {
 public:
  /// A bag's folder, or one of its .db3 files. not_found where there is none, else as
  /// BagFile::open().
  [[nodiscard]] static Result<BagReader> open(const std::string& target);

  /// Empty at the end.
  [[nodiscard]] Result<std::optional<Message>> next();
  /// The stamps of the first and the last message; empty for a bag without any.
  struct Span {
    Timestamp first{};
    Timestamp last{};
  };
  [[nodiscard]] Result<std::optional<Span>> span() const;
  [[nodiscard]] const std::string& target() const { return target_; }

 private:
  explicit BagReader(std::string target) : target_(std::move(target)) {}
  [[nodiscard]] Result<void> open_next();

  std::string target_;
  std::vector<std::string> files_;
  std::size_t next_file_ = 0;
  std::optional<BagFile> file_;
  store::Statement query_;  ///< after its file: finalised before that closes
};

}  // namespace lifeline::bag
