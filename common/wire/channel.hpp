#pragma once

#include <cstdint>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::wire {

/// Where a state machine puts the samples of one topic. Never blocks; the environment may refuse.
template <typename Message>
class Outbox {
 public:
  virtual ~Outbox() = default;
  /// Publishes one sample. An error means that this sample did not leave; a later one may.
  [[nodiscard]] virtual Result<void> put(const Message& message) = 0;
  /// Whether anybody reads (scans are sent only then).
  [[nodiscard]] virtual bool has_reader() const = 0;
  /// Says that this end is alive though it has nothing to say, where the topic asks for that.
  virtual void assert_alive() {}
};

/// Where a state machine takes the samples of one topic from.
template <typename Message>
class Inbox {
 public:
  virtual ~Inbox() = default;
  /// All samples that arrived since the last call, in order of arrival. Never blocks.
  [[nodiscard]] virtual std::vector<Message> take() = 0;
  /// Samples the middleware refused or that could not be decoded.
  [[nodiscard]] virtual std::uint64_t refused() const = 0;
};

}  // namespace lifeline::wire
