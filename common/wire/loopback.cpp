#include "common/wire/loopback.hpp"

#include <algorithm>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/check.hpp"
#include "common/wire/topic_key.hpp"

namespace lifeline::wire {

/// One topic.
template <typename Message>
class LoopbackTopic : public std::enable_shared_from_this<LoopbackTopic<Message>> {
 public:
  using Key = TopicKey<Message>;

  explicit LoopbackTopic(std::size_t capacity) : capacity_(capacity) {
    LIFELINE_CHECK(capacity > 0);
  }

  [[nodiscard]] std::unique_ptr<Outbox<Message>> make_writer() {
    auto writer = std::make_unique<Writer>(this->shared_from_this());
    std::lock_guard lock(mutex_);
    writers_.push_back(writer.get());
    return writer;
  }

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

template <typename Message>
using SharedTopic = std::shared_ptr<LoopbackTopic<Message>>;

struct LoopbackBus::Topics {
  explicit Topics(std::size_t capacity) {
    std::apply([capacity](auto&... topic) { (make(topic, capacity), ...); }, all);
  }

  template <typename Message>
  static void make(SharedTopic<Message>& topic, std::size_t capacity) {
    topic = std::make_shared<LoopbackTopic<Message>>(capacity);
  }

  std::tuple<SharedTopic<HelmetPose>, SharedTopic<HelmetScan>, SharedTopic<TsdTile>,
             SharedTopic<TileRequest>, SharedTopic<TileCopy>, SharedTopic<MergeDirective>,
             SharedTopic<DirectiveCopy>, SharedTopic<MergeEvidence>, SharedTopic<AgentStatus>,
             SharedTopic<Detection>, SharedTopic<Alert>>
      all;
};

LoopbackBus::LoopbackBus(std::size_t capacity) : topics_(std::make_shared<Topics>(capacity)) {}

template <typename Message>
std::unique_ptr<Outbox<Message>> LoopbackBus::writer() {
  return std::get<SharedTopic<Message>>(topics_->all)->make_writer();
}

template <typename Message>
std::unique_ptr<Inbox<Message>> LoopbackBus::reader() {
  return std::get<SharedTopic<Message>>(topics_->all)->make_reader();
}

#define LIFELINE_LOOPBACK(Message)                                          \
  template std::unique_ptr<Outbox<Message>> LoopbackBus::writer<Message>(); \
  template std::unique_ptr<Inbox<Message>> LoopbackBus::reader<Message>();
LIFELINE_LOOPBACK(HelmetPose)
LIFELINE_LOOPBACK(HelmetScan)
LIFELINE_LOOPBACK(TsdTile)
LIFELINE_LOOPBACK(TileRequest)
LIFELINE_LOOPBACK(TileCopy)
LIFELINE_LOOPBACK(MergeDirective)
LIFELINE_LOOPBACK(DirectiveCopy)
LIFELINE_LOOPBACK(MergeEvidence)
LIFELINE_LOOPBACK(AgentStatus)
LIFELINE_LOOPBACK(Detection)
LIFELINE_LOOPBACK(Alert)
#undef LIFELINE_LOOPBACK

}  // namespace lifeline::wire
