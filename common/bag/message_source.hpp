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

/// Where recorded messages come from, in the order of their stamps. One owner, not thread-safe.
class MessageSource {
 public:
  virtual ~MessageSource() = default;

  /// Empty at the end, behind which more may come later where it is being recorded just now.
  [[nodiscard]] virtual Result<std::optional<Message>> next() = 0;
  /// The stamps of the first and the last message; empty where there is none.
  struct Span {
    Timestamp first{};
    Timestamp last{};
  };
  [[nodiscard]] virtual Result<std::optional<Span>> span() const = 0;
  /// What it is called, for people.
  [[nodiscard]] virtual const std::string& target() const = 0;

 protected:
  MessageSource() = default;
  MessageSource(const MessageSource&) = default;
  MessageSource(MessageSource&&) = default;
  MessageSource& operator=(const MessageSource&) = default;
  MessageSource& operator=(MessageSource&&) = default;
};

}  // namespace lifeline::bag
