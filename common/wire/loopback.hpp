#pragma once

// All topics within one process: what Fast DDS does between processes, without it. For tests, and
// for a whole fleet on simulated time.

#include <cstddef>
#include <memory>

#include "common/wire/channel.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::wire {

/// All topics of one fleet. Writers and readers may outlive the bus; thread-safe. Every sample
/// reaches every reader of its topic, also one of the writer's own side. As with KEEP_LAST 1, an
/// unread sample is replaced by a newer one of its key.
class LoopbackBus {
 public:
  static constexpr std::size_t kDefaultCapacity = 16384;

  /// `capacity`: most unread samples that a reader holds; beyond it the oldest are dropped.
  explicit LoopbackBus(std::size_t capacity = kDefaultCapacity);

  template <typename Message>
  [[nodiscard]] std::unique_ptr<Outbox<Message>> writer();
  /// Where the topic is transient local, the reader starts with what the present writers wrote
  /// last.
  template <typename Message>
  [[nodiscard]] std::unique_ptr<Inbox<Message>> reader();

 private:
  struct Topics;  // compiled once, for each of the messages
  std::shared_ptr<Topics> topics_;
};

}  // namespace lifeline::wire
