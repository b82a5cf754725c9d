#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/bag/message_source.hpp"

namespace lifeline::bag {

/// All messages of a rosbag2 recording (SQLite), file after file in the order of their beginnings,
/// within a file in the order of their stamps. From anywhere; metadata.yaml is not needed.
class BagReader final : public MessageSource {
 public:
  /// A bag's folder, or one of its .db3 files. not_found where there is none, else as
  /// BagFile::open().
  [[nodiscard]] static Result<BagReader> open(const std::string& target);

  [[nodiscard]] Result<std::optional<Message>> next() override;
  [[nodiscard]] Result<std::optional<Span>> span() const override;
  [[nodiscard]] const std::string& target() const override { return target_; }

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
