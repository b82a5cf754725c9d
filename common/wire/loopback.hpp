#pragma once

// All topics within one process: what Fast DDS does between processes, without it. For tests, and
// for a whole fleet on simulated time.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/check.hpp"
#include "common/wire/channel.hpp"
#include "common/wire/topic_key.hpp"

namespace lifeline::wire {

/// One topic: every sample reaches every reader, also one of the writer's own side. As with
/// KEEP_LAST 1, an unread sample is replaced by a newer one of its key. Thread-safe.
template <typename Message>
class LoopbackTopic : public std::enable_shared_from_this<LoopbackTopic<Message>> {
 public:
  using Key = TopicKey<Message>;

  /// `capacity`: most unread samples that a reader holds; beyond it the oldest are dropped.
  explicit LoopbackTopic(std::size_t capacity) : capacity_(capacity) {
    LIFELINE_CHECK(capacity > 0);
  }

  [[nodiscard]] std::unique_ptr<Outbox<Message>> make_writer() {
    auto writer = std::make_unique<Writer>(this->shared_from_this());
    std::lock_guard lock(mutex_);
    writers_.push_back(writer.get());
    return writer;
  }

  /// Where the topic is transient local, the reader starts with what the present writers wrote
  /// last.
  [[nodiscard]] std::unique_ptr<Inbox<Message>> make_reader() {
    auto reader = std::make_unique<Reader>(this->shared_from_this());
    std::lock_guard lock(mutex_);
    for (const Writer* writer : writers_) {
      for (const auto& [key, message] : writer->last) reader->deliver(key, message);
    }
    readers_.push_back(reader.get());
    return reader;
  }

 private:
  struct Writer final : Outbox<Message> {
    explicit Writer(std::shared_ptr<LoopbackTopic> of) : topic(std::move(of)) {}
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() override {
      std::lock_guard lock(topic->mutex_);
      std::erase(topic->writers_, this);
    }

    [[nodiscard]] Result<void> put(const Message& message) override {
      const Key key = topic_key(message);
      std::lock_guard lock(topic->mutex_);
      if constexpr (kReachesLateReaders<Message>) last.insert_or_assign(key, message);
      for (Reader* reader : topic->readers_) reader->deliver(key, message);
      return {};
    }
    [[nodiscard]] bool has_reader() const override {
      std::lock_guard lock(topic->mutex_);
      return !topic->readers_.empty();
    }

    const std::shared_ptr<LoopbackTopic> topic;
    std::map<Key, Message> last;  ///< what readers that come late are told
  };

  struct Reader final : Inbox<Message> {
    explicit Reader(std::shared_ptr<LoopbackTopic> of) : topic(std::move(of)) {}
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() override {
      std::lock_guard lock(topic->mutex_);
      std::erase(topic->readers_, this);
    }

    [[nodiscard]] std::vector<Message> take() override {
      std::lock_guard lock(topic->mutex_);
      std::vector<Message> taken(std::make_move_iterator(unread.begin()),
                                 std::make_move_iterator(unread.end()));
      unread.clear();
      place.clear();
      return taken;
    }
    [[nodiscard]] std::uint64_t refused() const override {
      std::lock_guard lock(topic->mutex_);
      return dropped;
    }

    void deliver(const Key& key, const Message& message) {
      if (const auto known = place.find(key); known != place.end()) {
        unread.erase(known->second);
        place.erase(known);
      } else if (unread.size() == topic->capacity_) {
        place.erase(topic_key(unread.front()));
        unread.pop_front();
        ++dropped;
      }
      place.emplace(key, unread.insert(unread.end(), message));
    }

    const std::shared_ptr<LoopbackTopic> topic;
    std::list<Message> unread;  ///< in order of arrival
    std::map<Key, typename std::list<Message>::iterator> place;
    std::uint64_t dropped = 0;
  };

  const std::size_t capacity_;
  std::mutex mutex_;  ///< guards everything below and the insides of all writers and readers
  std::vector<Writer*> writers_;
  std::vector<Reader*> readers_;
};

/// All topics of one fleet. Writers and readers may outlive the bus; thread-safe.
class LoopbackBus {
 public:
  static constexpr std::size_t kDefaultCapacity = 16384;

  explicit LoopbackBus(std::size_t capacity = kDefaultCapacity)
      : topics_(make_topic<HelmetPose>(capacity), make_topic<HelmetScan>(capacity),
                make_topic<TsdTile>(capacity), make_topic<TileRequest>(capacity),
                make_topic<TileCopy>(capacity), make_topic<MergeDirective>(capacity),
                make_topic<DirectiveCopy>(capacity), make_topic<MergeEvidence>(capacity),
                make_topic<AgentStatus>(capacity), make_topic<Detection>(capacity),
                make_topic<Alert>(capacity)) {}

  template <typename Message>
  [[nodiscard]] std::unique_ptr<Outbox<Message>> writer() {
    return std::get<std::shared_ptr<LoopbackTopic<Message>>>(topics_)->make_writer();
  }
  template <typename Message>
  [[nodiscard]] std::unique_ptr<Inbox<Message>> reader() {
    return std::get<std::shared_ptr<LoopbackTopic<Message>>>(topics_)->make_reader();
  }

 private:
  template <typename Message>
  static std::shared_ptr<LoopbackTopic<Message>> make_topic(std::size_t capacity) {
    return std::make_shared<LoopbackTopic<Message>>(capacity);
  }

  template <typename... Messages>
  using Topics = std::tuple<std::shared_ptr<LoopbackTopic<Messages>>...>;
  Topics<HelmetPose, HelmetScan, TsdTile, TileRequest, TileCopy, MergeDirective, DirectiveCopy,
         MergeEvidence, AgentStatus, Detection, Alert>
      topics_;
};

}  // namespace lifeline::wire
